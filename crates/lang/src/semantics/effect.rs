//! Effect of an instruction on the current result.

use super::Context;
use super::shape::Shape;
use super::typing::is_standard;
use crate::syntax::ast::{Condition, Instruction, Operand, Operation, Part, Path, Verb};

/// Current result after an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leaves {
    /// Unchanged.
    Same,
    /// New value.
    Value,
    /// Undefined.
    Nothing,
}

/// Whether an instruction uses the current result, and the current result after it.
pub fn effect(instruction: &Instruction, context: &Context<'_>) -> (bool, Leaves) {
    match &instruction.operation {
        Some(Operation::Simple { operator, operands }) => match operator.verb {
            Verb::Ld => (false, Leaves::Value),
            Verb::St => (true, Leaves::Same),
            Verb::S | Verb::R if operands.first().is_none_or(|operand| block(operand, context).is_none()) => {
                (true, Leaves::Same)
            }
            verb if verb.is_block_input() => (true, Leaves::Nothing),
            _ => (true, Leaves::Value),
        },
        Some(Operation::Parenthesis { .. }) => (true, Leaves::Value),
        Some(Operation::Jump { condition, .. } | Operation::Return { condition }) => {
            (*condition != Condition::Always, Leaves::Same)
        }
        Some(Operation::Call { condition, .. }) => (*condition != Condition::Always, Leaves::Nothing),
        Some(Operation::Function { name, arguments }) => {
            // Whether an unknown word would use the current result is not known.
            let is_known = context.project.find(&name.text).is_some() || is_standard(&name.key());
            (is_known && !arguments.enclosed, Leaves::Value)
        }
        Some(Operation::Broken) => (false, Leaves::Value),
        None => (false, Leaves::Same),
    }
}

/// Function block that an operand is an instance of.
pub fn block(operand: &Operand, context: &Context<'_>) -> Option<super::PouId> {
    let Operand::Variable(path) = operand else { return None };
    match shape(path, context)? {
        Shape::Instance(id) => Some(id),
        _ => None,
    }
}

/// Shape of a path, if it can be resolved. Nothing is reported.
pub fn shape(path: &Path, context: &Context<'_>) -> Option<Shape> {
    let (_, _, symbol) = context.project.variable(context.id, &path.root.text)?;
    path.parts.iter().try_fold(symbol.shape.clone()?, |shape, part| match (part, shape) {
        (Part::Member(name), Shape::Structure(structure)) => {
            structure.members.iter().find(|m| m.name.eq_ignore_ascii_case(&name.text)).map(|m| m.shape.clone())
        }
        (Part::Member(name), Shape::Instance(id)) => {
            context.project.symbols(id).find(&name.text).and_then(|(_, symbol)| symbol.shape.clone())
        }
        (Part::Index(..), Shape::Array { of, .. }) => Some(*of),
        _ => None,
    })
}
