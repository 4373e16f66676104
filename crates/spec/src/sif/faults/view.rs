//! Detection of faults by Boolean differences, on 64 valuations at once or in a solver.
//!
//! Formulas are trees, so an equation depends on each node as on a single value, and the *Boolean difference* of the
//! equation by the node is the product of the differences along the path to the root (Sellers, Hsiao and Bearnson,
//! "Analyzing errors with the Boolean difference", 1968). A fault is detected where it changes its node, the node
//! changes the equation, and the equation an output: no mutant is ever built.

use fixedbitset::FixedBitSet;

use super::super::formula::{Operator, SignalId};
use super::super::solver::{Literal, Solver};
use super::changes::{Change, Fault};
use super::logic::{Logic, Words, deciding};
use super::model::Model;
use super::nodes::What;

/// Values of a model's signals and nodes under some valuations.
pub struct View<V> {
    /// Value of each signal of the specification; meaningless outside the cone.
    pub signals: Vec<V>,
    /// Value of each node.
    pub values: Vec<V>,
    /// Boolean difference of the parent by each node.
    deciding: Vec<V>,
    /// Observability: where an output of the function changes with the node.
    pub observed: Vec<V>,
}

impl View<u64> {
    /// Evaluates a model on up to 64 valuations; the first is bit 0.
    pub fn of(model: &Model<'_>, valuations: &[FixedBitSet]) -> Self {
        let mut signals = vec![0; model.specification.signals.len()];
        for input in model.cone.all_inputs() {
            let bits = valuations.iter().enumerate().take(64);
            signals[input.0] =
                bits.fold(0, |word, (bit, valuation)| word | u64::from(valuation.contains(input.0)) << bit);
        }
        for id in &model.cone.definitions {
            if let Some(formula) = model.specification.definition(*id) {
                signals[id.0] = formula.evaluate(&|signal| signals[signal.0]);
            }
        }
        Self::with(&mut Words, model, signals)
    }

    /// Valuations in which a fault changes its own node.
    pub fn changes(&self, model: &Model<'_>, fault: &Fault) -> u64 {
        self.change(&mut Words, model, fault)
    }

    /// Valuations in which a fault is detected at an output (the mutant is killed).
    pub fn kills(&self, model: &Model<'_>, fault: &Fault) -> u64 {
        match self.observed[fault.node] {
            0 => 0,
            observed => observed & self.changes(model, fault),
        }
    }
}

impl View<Literal> {
    /// Encodes the nodes of a model whose signals are these literals.
    pub fn in_solver(solver: &mut Solver, model: &Model<'_>, signals: Vec<Literal>) -> Self {
        Self::with(solver, model, signals)
    }

    /// Literal that is true when a fault is detected at an output.
    pub fn kills(&self, solver: &mut Solver, model: &Model<'_>, fault: &Fault) -> Literal {
        let changes = self.change(solver, model, fault);
        solver.and([changes, self.observed[fault.node]])
    }
}

impl<V: Copy> View<V> {
    fn with<L: Logic<Value = V>>(logic: &mut L, model: &Model<'_>, signals: Vec<V>) -> Self {
        let (yes, no) = (logic.always(true), logic.always(false));
        let mut view = Self {
            signals,
            values: vec![no; model.nodes.len()],
            deciding: vec![yes; model.nodes.len()],
            observed: vec![no; model.nodes.len()],
        };
        for (at, node) in model.nodes.iter().enumerate() {
            let plain = match &node.what {
                What::Constant(value) => logic.always(*value),
                What::Literal(signal) => view.signals[signal.0],
                What::Gate(operator, operands) => {
                    let values = view.all(operands);
                    for (operand, deciding) in operands.iter().zip(deciding(logic, *operator, &values)) {
                        view.deciding[*operand] = deciding;
                    }
                    logic.gate(*operator, &values)
                }
            };
            view.values[at] = if node.is_negated { logic.opposite(plain) } else { plain };
        }
        for (position, equation) in model.equations.iter().enumerate() {
            view.observed[equation.root] = view.seen(logic, model, position);
        }
        for (at, node) in model.nodes.iter().enumerate().rev() {
            if let Some(parent) = node.parent {
                view.observed[at] = logic.both(view.deciding[at], view.observed[parent]);
            }
        }
        view
    }

    /// Where an output of the function changes with an equation's signal.
    fn seen<L: Logic<Value = V>>(&self, logic: &mut L, model: &Model<'_>, equation: usize) -> V {
        let equation = &model.equations[equation];
        if equation.is_output {
            return logic.always(true);
        }
        let mut signals = self.signals.clone();
        signals[equation.signal.0] = logic.opposite(signals[equation.signal.0]);
        let mut seen = logic.always(false);
        for user in &equation.users {
            if let Some(formula) = model.specification.definition(*user) {
                signals[user.0] = logic.formula(formula, &signals);
                if model.outputs().contains(user) {
                    let differs = logic.differ(signals[user.0], self.signals[user.0]);
                    seen = logic.either(seen, differs);
                }
            }
        }
        seen
    }

    fn all(&self, nodes: &[usize]) -> Vec<V> {
        nodes.iter().map(|node| self.values[*node]).collect()
    }

    /// Where a fault changes its own node. A negation of the node does not matter here.
    fn change<L: Logic<Value = V>>(&self, logic: &mut L, model: &Model<'_>, fault: &Fault) -> V {
        let node = &model.nodes[fault.node];
        let value = self.values[fault.node];
        let plain = if node.is_negated { logic.opposite(value) } else { value };
        let operands: &[usize] = if let What::Gate(_, operands) = &node.what { operands } else { &[] };
        match fault.change {
            Change::Negated => logic.always(true),
            Change::Stuck(stuck) => {
                let stuck = logic.always(stuck);
                logic.differ(value, stuck)
            }
            Change::Operator(other) => {
                let changed = logic.gate(other, &self.all(operands));
                logic.differ(plain, changed)
            }
            Change::Converse => {
                let turned: Vec<V> = operands.iter().rev().map(|node| self.values[*node]).collect();
                let changed = logic.gate(Operator::Implies, &turned);
                logic.differ(plain, changed)
            }
            Change::Without(position) => self.omission(logic, &node.what, operands[position], plain),
            Change::With(signal, is_plain) => {
                let literal = self.literal(logic, signal, is_plain);
                let changed = match &node.what {
                    What::Gate(Operator::And, _) => logic.both(plain, literal),
                    _ => logic.either(plain, literal),
                };
                logic.differ(plain, changed)
            }
            Change::Literal(signal, is_plain) => {
                let literal = self.literal(logic, signal, is_plain);
                logic.differ(value, literal)
            }
        }
    }

    /// Where a gate changes when an operand is omitted.
    fn omission<L: Logic<Value = V>>(&self, logic: &mut L, gate: &What, operand: usize, plain: V) -> V {
        let others = self.deciding[operand];
        match gate {
            What::Gate(Operator::And, _) => logic.differ(plain, others),
            What::Gate(Operator::Or, _) => {
                let others = logic.opposite(others);
                logic.differ(plain, others)
            }
            _ => self.values[operand],
        }
    }

    fn literal<L: Logic<Value = V>>(&self, logic: &L, signal: SignalId, is_plain: bool) -> V {
        let value = self.signals[signal.0];
        if is_plain { value } else { logic.opposite(value) }
    }
}
