//! Equations as nodes in a row, in which a fault has a place.

use super::super::formula::{Formula, Operator, SignalId};

/// A part of an equation. Negations are no parts of their own: they belong to what is negated.
#[derive(Clone, Debug)]
pub struct Node {
    /// The equation: its position among those of the model.
    pub equation: usize,
    /// What it is an operand of.
    pub parent: Option<usize>,
    /// Whether the opposite counts.
    pub is_negated: bool,
    /// What it is without that.
    pub what: What,
}

/// What a node is.
#[derive(Clone, Debug)]
pub enum What {
    /// TRUE or FALSE.
    Constant(bool),
    /// A name.
    Literal(SignalId),
    /// An operator with nodes as operands.
    Gate(Operator, Vec<usize>),
}

/// Adds the nodes of a formula, operands before what they are operands of. Gives the last, which is the whole.
pub fn grow(nodes: &mut Vec<Node>, equation: usize, formula: &Formula) -> usize {
    let (mut is_negated, mut formula) = (false, formula);
    while let Formula::Not(inner) = formula {
        (is_negated, formula) = (!is_negated, inner);
    }
    let what = match formula {
        Formula::Gate(operator, operands) => {
            What::Gate(*operator, operands.iter().map(|operand| grow(nodes, equation, operand)).collect())
        }
        Formula::Signal(signal) => What::Literal(*signal),
        Formula::Constant(value) => What::Constant(*value),
        Formula::Not(_) => What::Constant(false),
    };
    let this = nodes.len();
    if let What::Gate(_, operands) = &what {
        operands.iter().for_each(|operand| nodes[*operand].parent = Some(this));
    }
    nodes.push(Node { equation, parent: None, is_negated, what });
    this
}

/// The formula that a node was made of.
pub fn formula(nodes: &[Node], node: usize) -> Formula {
    let plain = match &nodes[node].what {
        What::Constant(value) => Formula::Constant(*value),
        What::Literal(signal) => Formula::Signal(*signal),
        What::Gate(operator, operands) => {
            Formula::Gate(*operator, operands.iter().map(|operand| formula(nodes, *operand)).collect())
        }
    };
    if nodes[node].is_negated { Formula::Not(Box::new(plain)) } else { plain }
}
