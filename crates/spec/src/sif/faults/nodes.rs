//! Nodes of equations, the places of faults.

use super::super::formula::{Formula, Operator, SignalId};

/// Subformula of an equation. Negations are not nodes: they belong to their operand.
#[derive(Clone, Debug)]
pub struct Node {
    /// Position of its equation in the model.
    pub equation: usize,
    /// Parent node.
    pub parent: Option<usize>,
    /// Whether the node is negated.
    pub is_negated: bool,
    /// Content without that negation.
    pub what: What,
}

/// Content of a node.
#[derive(Clone, Debug)]
pub enum What {
    /// Constant.
    Constant(bool),
    /// Name.
    Literal(SignalId),
    /// Operator with nodes as operands.
    Gate(Operator, Vec<usize>),
}

/// Adds the nodes of a formula in postorder; returns the root.
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

/// Rebuilds the formula of a node.
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
