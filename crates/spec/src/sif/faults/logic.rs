//! Gate semantics, written once for 64 valuations at once and for literals of a solver.

use super::super::formula::{Formula, Operator, SignalId};
use super::super::solver::{Literal, Solver};

/// Boolean algebra that gates can be evaluated in.
pub trait Logic {
    /// Value: one Boolean or many.
    type Value: Copy;
    /// Constant.
    fn always(&self, value: bool) -> Self::Value;
    /// Negation.
    fn opposite(&self, a: Self::Value) -> Self::Value;
    /// Conjunction.
    fn both(&mut self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// Exclusive or.
    fn differ(&mut self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// Applies an operator to its operands.
    fn gate(&mut self, operator: Operator, operands: &[Self::Value]) -> Self::Value;
    /// Evaluates a formula with these values of signals.
    fn formula(&mut self, formula: &Formula, signals: &[Self::Value]) -> Self::Value;

    /// Disjunction.
    fn either(&mut self, a: Self::Value, b: Self::Value) -> Self::Value {
        let neither = self.both(self.opposite(a), self.opposite(b));
        self.opposite(neither)
    }
}

/// Bit-parallel evaluation of 64 valuations, one per bit.
pub struct Words;

impl Logic for Words {
    type Value = u64;

    fn always(&self, value: bool) -> u64 {
        if value { u64::MAX } else { 0 }
    }

    fn opposite(&self, a: u64) -> u64 {
        !a
    }

    fn both(&mut self, a: u64, b: u64) -> u64 {
        a & b
    }

    fn differ(&mut self, a: u64, b: u64) -> u64 {
        a ^ b
    }

    fn gate(&mut self, operator: Operator, operands: &[u64]) -> u64 {
        operator.apply(operands.iter().copied())
    }

    fn formula(&mut self, formula: &Formula, signals: &[u64]) -> u64 {
        formula.evaluate(&|signal: SignalId| signals[signal.0])
    }
}

impl Logic for Solver {
    type Value = Literal;

    fn always(&self, value: bool) -> Literal {
        self.constant(value)
    }

    fn opposite(&self, a: Literal) -> Literal {
        !a
    }

    fn both(&mut self, a: Literal, b: Literal) -> Literal {
        self.and([a, b])
    }

    fn differ(&mut self, a: Literal, b: Literal) -> Literal {
        self.xor(a, b)
    }

    fn gate(&mut self, operator: Operator, operands: &[Literal]) -> Literal {
        self.operator(operator, operands)
    }

    fn formula(&mut self, formula: &Formula, signals: &[Literal]) -> Literal {
        Self::formula(self, formula, &|signal: SignalId| signals[signal.0])
    }
}

/// For each operand, the Boolean difference of the gate by it: where the gate changes with this operand alone.
pub fn deciding<L: Logic>(logic: &mut L, operator: Operator, operands: &[L::Value]) -> Vec<L::Value> {
    match operator {
        Operator::And => all_others(logic, operands),
        Operator::Or => {
            let not: Vec<L::Value> = operands.iter().map(|operand| logic.opposite(*operand)).collect();
            all_others(logic, &not)
        }
        Operator::Implies => {
            // An implication is a disjunction with its first operand negated.
            let not = operands.iter().enumerate();
            let not: Vec<L::Value> =
                not.map(|(at, operand)| if at == 0 { *operand } else { logic.opposite(*operand) }).collect();
            all_others(logic, &not)
        }
        Operator::Xor | Operator::Iff => vec![logic.always(true); operands.len()],
        Operator::AtMostOne | Operator::ExactlyOne => {
            let counts = counted_others(logic, operands);
            let is_exact = operator == Operator::ExactlyOne;
            counts
                .into_iter()
                .map(|(one, two)| {
                    let few = logic.opposite(two);
                    if is_exact { few } else { logic.both(one, few) }
                })
                .collect()
        }
    }
}

/// For each value, the conjunction of all others (prefix and suffix products).
fn all_others<L: Logic>(logic: &mut L, values: &[L::Value]) -> Vec<L::Value> {
    let mut others = Vec::with_capacity(values.len());
    let mut left = logic.always(true);
    for value in values {
        others.push(left);
        left = logic.both(left, *value);
    }
    let mut right = logic.always(true);
    for (value, other) in values.iter().zip(&mut others).rev() {
        *other = logic.both(*other, right);
        right = logic.both(right, *value);
    }
    others
}

/// For each value, whether at least one and whether at least two of the others are true.
fn counted_others<L: Logic>(logic: &mut L, values: &[L::Value]) -> Vec<(L::Value, L::Value)> {
    let none = (logic.always(false), logic.always(false));
    let mut others = Vec::with_capacity(values.len());
    let mut left = none;
    let one = |value: L::Value| (value, none.1);
    for value in values {
        others.push(left);
        left = sum(logic, left, one(*value));
    }
    let mut right = none;
    for (value, other) in values.iter().zip(&mut others).rev() {
        *other = sum(logic, *other, right);
        right = sum(logic, right, one(*value));
    }
    others
}

/// Sum of two counts, each given as "at least one" and "at least two".
fn sum<L: Logic>(logic: &mut L, a: (L::Value, L::Value), b: (L::Value, L::Value)) -> (L::Value, L::Value) {
    let across = logic.both(a.0, b.0);
    let within = logic.either(a.1, b.1);
    (logic.either(a.0, b.0), logic.either(across, within))
}
