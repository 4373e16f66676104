//! Enumeration of all single faults of a model.

use super::super::formula::{Operator, SignalId};
use super::class::Class;
use super::model::Model;
use super::nodes::{What, formula};

/// Single fault: a change at one node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fault {
    /// Class of the fault.
    pub class: Class,
    /// Position of the node in the model.
    pub node: usize,
    /// Change of the node.
    pub change: Change,
}

/// Change of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Change {
    /// Negation.
    Negated,
    /// Stuck-at constant.
    Stuck(bool),
    /// Replacement of the operator.
    Operator(Operator),
    /// Reversed implication: `->` from the second operand to the first.
    Converse,
    /// Omission of the operand at this position.
    Without(usize),
    /// Insertion of an operand: this signal if TRUE, its negation if FALSE.
    With(SignalId, bool),
    /// Replacement by this literal (negated if FALSE).
    Literal(SignalId, bool),
}

/// Lists the faults of a function, by class, then by position.
#[must_use]
pub fn faults(model: &Model<'_>) -> Vec<Fault> {
    let mut found = Vec::new();
    for (node, at) in model.nodes.iter().enumerate() {
        let mut add = |class, change| found.push(Fault { class, node, change });
        let is_root = at.parent.is_none();
        match &at.what {
            What::Constant(_) => continue,
            What::Literal(own) => {
                add(Class::LiteralNegation, Change::Negated);
                for name in model.names_for(at.equation).filter(|name| name != own) {
                    add(Class::LiteralReference, Change::Literal(name, true));
                    add(Class::LiteralReference, Change::Literal(name, false));
                }
            }
            What::Gate(operator, operands) => {
                if !is_root {
                    add(Class::TermNegation, Change::Negated);
                }
                let same = |a: usize, b: usize| formula(&model.nodes, a) == formula(&model.nodes, b);
                for other in others(*operator, operands.len()) {
                    add(Class::Operator, Change::Operator(*other));
                }
                if let (Operator::Implies | Operator::Iff, [a, b]) = (operator, operands.as_slice())
                    && !same(*a, *b)
                {
                    add(Class::Operator, Change::Converse);
                }
                if matches!(operator, Operator::And | Operator::Or | Operator::Xor) && operands.len() > 1 {
                    for (position, operand) in operands.iter().enumerate() {
                        // Of adjacent equal operands, omitting either is one fault.
                        if position > 0 && same(operands[position - 1], *operand) {
                            continue;
                        }
                        let is_literal = matches!(model.nodes[*operand].what, What::Literal(_));
                        let class = if is_literal { Class::LiteralOmission } else { Class::TermOmission };
                        add(class, Change::Without(position));
                    }
                }
                if matches!(operator, Operator::And | Operator::Or) {
                    for name in model.names_for(at.equation) {
                        for value in [true, false] {
                            let is_there = |operand: &usize| {
                                let operand = &model.nodes[*operand];
                                operand.is_negated != value && matches!(operand.what, What::Literal(of) if of == name)
                            };
                            if !operands.iter().any(is_there) {
                                add(Class::LiteralInsertion, Change::With(name, value));
                            }
                        }
                    }
                }
            }
        }
        if is_root {
            add(Class::ExpressionNegation, Change::Negated);
        }
        add(Class::StuckAtFalse, Change::Stuck(false));
        add(Class::StuckAtTrue, Change::Stuck(true));
    }
    found.sort_by_key(|fault| (fault.class, fault.node));
    found
}

/// Operators that an operator is easily confused with, apart from the reversed `->`.
fn others(operator: Operator, operands: usize) -> &'static [Operator] {
    match operator {
        _ if operands < 2 => &[],
        Operator::And => &[Operator::Or],
        Operator::Or => &[Operator::And, Operator::Xor],
        Operator::Xor if operands == 2 => &[Operator::Or, Operator::And, Operator::Iff],
        Operator::Xor => &[Operator::Or, Operator::And],
        Operator::Implies => &[Operator::Iff, Operator::And, Operator::Or],
        Operator::Iff => &[Operator::Xor, Operator::Implies],
        Operator::AtMostOne => &[Operator::ExactlyOne, Operator::Or],
        Operator::ExactlyOne => &[Operator::AtMostOne, Operator::Or, Operator::Xor],
    }
}
