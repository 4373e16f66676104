//! What matters to some signals: what they are computed from, and the restrictions that connect these inputs with others.

use fixedbitset::FixedBitSet;

use super::formula::{Formula, SignalId};
use super::solver::{Literal, Solver};
use super::specification::{Restriction, Specification};

/// A part of a specification that can be looked at without the rest: no restriction speaks of signals inside and outside of it.
#[derive(Clone, Debug)]
pub struct Cone<'s> {
    /// The specification.
    pub specification: &'s Specification,
    /// The inputs that the signals are computed from: what a test of them sets, in the order in which formulas name them.
    pub inputs: Vec<SignalId>,
    /// Further inputs, connected with these by restrictions.
    pub connected: Vec<SignalId>,
    /// The definitions that are needed for all that, each behind those it uses.
    pub definitions: Vec<SignalId>,
    /// The restrictions that have to be kept.
    pub restrictions: Vec<&'s Restriction>,
}

impl<'s> Cone<'s> {
    /// What matters to the outputs and auxiliary values of a function.
    #[must_use]
    pub fn of_function(specification: &'s Specification, function: usize) -> Self {
        let restrictions = specification.restrictions_of(function).collect();
        Self::of(specification, &specification.functions[function].equations, restrictions)
    }

    /// What matters to these signals, where these restrictions are kept.
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
            // What speaks of no input at all is either always so or never: it matters to everyone.
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

    /// The inputs of both kinds.
    pub fn all_inputs(&self) -> impl Iterator<Item = SignalId> {
        self.inputs.iter().chain(&self.connected).copied()
    }

    /// Tells a solver what the signals of the cone mean: a literal for each of them. Restrictions are only made to literals,
    /// in their order, so that whoever solves can assume them.
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

    /// Whether the restrictions allow what signals have; `value` gives 64 valuations at once.
    pub fn allows(&self, value: &impl Fn(SignalId) -> u64) -> u64 {
        self.restrictions.iter().fold(u64::MAX, |all, restriction| all & restriction.allowed.evaluate(value))
    }
}

/// The literals of a cone in a solver.
pub struct Encoded {
    /// One for each signal of the specification; those outside the cone mean nothing.
    pub literals: Vec<Literal>,
    /// One for each restriction of the cone.
    pub restrictions: Vec<Literal>,
}

impl Encoded {
    /// The inputs that are TRUE in the model that a solver found last.
    #[must_use]
    pub fn model(&self, cone: &Cone<'_>, solver: &Solver) -> FixedBitSet {
        cone.specification.valuation(cone.all_inputs().filter(|input| solver.value(self.literals[input.0])))
    }
}

/// The inputs that a formula depends on, in the order in which definitions name them.
pub fn inputs_of(specification: &Specification, formula: &Formula) -> Vec<SignalId> {
    let mut inside = Inside::new(specification);
    formula.each_signal(&mut |signal| inside.add(signal));
    inside.inputs
}

/// Signals, with all they are computed from.
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

    /// Adds a signal. A list of what is still to be looked at takes the place of recursion: definitions can be many.
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
