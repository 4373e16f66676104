//! Cone of influence of signals, closed under restrictions that relate its inputs with others.

use fixedbitset::FixedBitSet;

use super::formula::{Formula, SignalId};
use super::solver::{Literal, Solver};
use super::specification::{Restriction, Specification};

/// Cone of influence: a self-contained part of a specification. No restriction mentions signals both inside and outside
/// it.
#[derive(Clone, Debug)]
pub struct Cone<'s> {
    /// Specification.
    pub specification: &'s Specification,
    /// Inputs that the signals are computed from, which a test sets, in the order in which formulas mention them.
    pub inputs: Vec<SignalId>,
    /// Further inputs, related to these by restrictions.
    pub connected: Vec<SignalId>,
    /// Definitions needed, in topological order: each after those it uses.
    pub definitions: Vec<SignalId>,
    /// Restrictions that apply to the cone.
    pub restrictions: Vec<&'s Restriction>,
}

impl<'s> Cone<'s> {
    /// Cone of all equations of a function.
    #[must_use]
    pub fn of_function(specification: &'s Specification, function: usize) -> Self {
        let restrictions = specification.restrictions_of(function).collect();
        Self::of(specification, &specification.functions[function].equations, restrictions)
    }

    /// Cone of these signals under these restrictions.
    #[must_use]
    pub fn of(specification: &'s Specification, signals: &[SignalId], restrictions: Vec<&'s Restriction>) -> Self {
        let mut inside = Inside::new(specification);
        signals.iter().for_each(|signal| inside.add(*signal));
        let inputs = inside.inputs.clone();
        let mut left: Vec<(&Restriction, Vec<SignalId>)> = restrictions
            .into_iter()
            .map(|restriction| (restriction, inputs_of(specification, &restriction.allowed)))
            .collect();
        let mut kept = FixedBitSet::with_capacity(specification.restrictions.len());
        loop {
            // A restriction without inputs is constant, so it applies to every cone.
            let meets = |of: &[SignalId]| of.is_empty() || of.iter().any(|input| inside.seen.contains(input.0));
            let (joins, others): (Vec<_>, Vec<_>) = left.into_iter().partition(|(_, of)| meets(of));
            left = others;
            if joins.is_empty() {
                break;
            }
            for (restriction, _) in joins {
                restriction.allowed.each_signal(&mut |signal| inside.add(signal));
                if let Some(at) = specification.restrictions.iter().position(|other| std::ptr::eq(other, restriction)) {
                    kept.insert(at);
                }
            }
        }
        let restrictions = kept.ones().map(|at| &specification.restrictions[at]).collect();
        let connected = inside.inputs[inputs.len()..].to_vec();
        let definitions = specification.order.iter().copied().filter(|id| inside.seen.contains(id.0)).collect();
        Self { specification, inputs, connected, definitions, restrictions }
    }

    /// Inputs of both kinds.
    pub fn all_inputs(&self) -> impl Iterator<Item = SignalId> {
        self.inputs.iter().chain(&self.connected).copied()
    }

    /// Encodes the cone in a solver: a literal for each signal. Restrictions become literals, too, in their order, and
    /// are not asserted, so that they can be assumed one by one.
    pub fn encode(&self, solver: &mut Solver) -> Encoded {
        let mut literals = vec![solver.constant(false); self.specification.signals.len()];
        for input in self.all_inputs() {
            literals[input.0] = solver.fresh();
        }
        for &id in &self.definitions {
            if let Some(formula) = self.specification.definition(id) {
                literals[id.0] = solver.formula(formula, &|signal| literals[signal.0]);
            }
        }
        let restrictions = self.restrictions.iter();
        let restrictions = restrictions
            .map(|restriction| solver.formula(&restriction.allowed, &|signal| literals[signal.0]))
            .collect();
        Encoded { literals, restrictions }
    }

    /// Whether the restrictions allow a valuation; `value` gives 64 valuations at once, one per bit.
    pub fn allows(&self, value: &impl Fn(SignalId) -> u64) -> u64 {
        self.restrictions.iter().fold(u64::MAX, |all, restriction| all & restriction.allowed.evaluate(value))
    }
}

/// Literals of a cone in a solver.
pub struct Encoded {
    /// Literal of each signal of the specification; meaningless outside the cone.
    pub literals: Vec<Literal>,
    /// Literal of each restriction of the cone.
    pub restrictions: Vec<Literal>,
}

impl Encoded {
    /// Inputs that are TRUE in the model found last.
    #[must_use]
    pub fn model(&self, cone: &Cone<'_>, solver: &Solver) -> FixedBitSet {
        cone.specification.valuation(cone.all_inputs().filter(|input| solver.value(self.literals[input.0])))
    }
}

/// Inputs that a formula depends on, in the order in which definitions mention them.
pub fn inputs_of(specification: &Specification, formula: &Formula) -> Vec<SignalId> {
    let mut inside = Inside::new(specification);
    formula.each_signal(&mut |signal| inside.add(signal));
    inside.inputs
}

/// Signals with everything they are computed from.
struct Inside<'s> {
    specification: &'s Specification,
    seen: FixedBitSet,
    inputs: Vec<SignalId>,
}

impl<'s> Inside<'s> {
    fn new(specification: &'s Specification) -> Self {
        let seen = FixedBitSet::with_capacity(specification.signals.len());
        Self { specification, seen, inputs: Vec::new() }
    }

    /// Adds a signal. Uses an explicit worklist, since chains of definitions can be long.
    fn add(&mut self, signal: SignalId) {
        let mut left = vec![signal];
        while let Some(signal) = left.pop() {
            if self.seen.put(signal.0) {
                continue;
            }
            match self.specification.definition(signal) {
                None => self.inputs.push(signal),
                Some(formula) => left.extend(formula.signals().into_iter().rev()),
            }
        }
    }
}
