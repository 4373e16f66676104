//! Fault model of a function: its equations as nodes, the names in scope, and observability.

use fixedbitset::FixedBitSet;

use super::super::cone::{Cone, inputs_of};
use super::super::formula::{Formula, SignalId};
use super::super::specification::Specification;
use super::nodes::{Node, grow};

/// Fault model of a function.
pub struct Model<'s> {
    /// Specification.
    pub specification: &'s Specification,
    /// Position of the function.
    pub function: usize,
    /// Cone of influence of its outputs and of the names that faults may introduce.
    pub cone: Cone<'s>,
    /// Names that faults may introduce.
    pub names: Vec<SignalId>,
    /// Own equations that its outputs are computed from.
    pub equations: Vec<Equation>,
    /// Nodes of all these equations, operands first.
    pub nodes: Vec<Node>,
}

/// Equation of a function.
pub struct Equation {
    /// Signal defined.
    pub signal: SignalId,
    /// Root node.
    pub root: usize,
    /// Whether the signal is an output of the function.
    pub is_output: bool,
    /// Definitions that depend on the signal, in the order of definitions.
    pub users: Vec<SignalId>,
}

impl<'s> Model<'s> {
    /// Builds the model of a function.
    #[must_use]
    pub fn new(specification: &'s Specification, function: usize) -> Self {
        let of = &specification.functions[function];
        let kept: Vec<_> = specification.restrictions_of(function).collect();
        let narrow = Cone::of(specification, &of.outputs, kept.clone());
        let varied = specification.valuation(narrow.inputs.iter().copied());

        let mut names = Vec::new();
        let mut seen = FixedBitSet::with_capacity(specification.signals.len());
        let mut add = |name: SignalId| {
            let is_new = !seen.put(name.0);
            let from = || inputs_of(specification, &Formula::Signal(name));
            if is_new && from().iter().all(|input| varied.contains(input.0)) {
                names.push(name);
            }
        };
        of.inputs.iter().chain(&of.outputs).chain(&of.equations).for_each(|name| add(*name));
        for equation in &of.equations {
            if let Some(formula) = specification.definition(*equation) {
                formula.signals().into_iter().for_each(&mut add);
            }
        }
        let wanted: Vec<SignalId> = of.outputs.iter().chain(&names).copied().collect();
        let cone = Cone::of(specification, &wanted, kept);

        let (mut equations, mut nodes) = (Vec::new(), Vec::new());
        for &signal in &of.equations {
            let Some(formula) = specification.definition(signal) else { continue };
            let users = users(&cone, signal);
            let is_output = of.outputs.contains(&signal);
            if is_output || users.iter().any(|user| of.outputs.contains(user)) {
                let root = grow(&mut nodes, equations.len(), formula);
                equations.push(Equation { signal, root, is_output, users });
            }
        }
        Self { specification, function, cone, names, equations, nodes }
    }

    /// Outputs of the function.
    #[must_use]
    pub fn outputs(&self) -> &'s [SignalId] {
        &self.specification.functions[self.function].outputs
    }

    /// Names that a fault may introduce into an equation without making it cyclic.
    pub fn names_for(&self, equation: usize) -> impl Iterator<Item = SignalId> {
        let equation = &self.equations[equation];
        self.names.iter().copied().filter(move |name| *name != equation.signal && !equation.users.contains(name))
    }
}

/// Definitions of a cone that depend on a signal, in order.
fn users(cone: &Cone<'_>, signal: SignalId) -> Vec<SignalId> {
    let mut found = cone.specification.valuation([signal]);
    let mut users = Vec::new();
    for &id in &cone.definitions {
        let mut uses = false;
        if let Some(formula) = cone.specification.definition(id) {
            formula.each_signal(&mut |used| uses |= found.contains(used.0));
        }
        if uses {
            found.insert(id.0);
            users.push(id);
        }
    }
    users
}
