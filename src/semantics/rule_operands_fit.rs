//! Every operand is of a kind its operator takes: a Boolean value to read, a variable to write.
//!
//! Passes: `LD TRUE`, `ST a`.
//! Fails: `LD 5`, `ST TRUE`.

use super::Context;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::{Operand, Operation, Verb, with_nested};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let instructions = with_nested(&context.pou.body);
    instructions
        .filter_map(|(instruction, _)| {
            let (operator, operand) = match instruction.operation.as_ref()? {
                Operation::Simple { operator, operands } => (operator, operands.first()?),
                Operation::Parenthesis { operator, first, .. } => (operator, first.as_ref()?),
                _ => return None,
            };
            let Operand::Constant(constant) = operand else { return None };
            let unfit = |message| Some(Diagnostic::new(Code::OperandUnfit, constant.span, message));
            if matches!(operator.verb, Verb::St | Verb::S | Verb::R) {
                return unfit(format!("`{operator}` writes its operand, so it must be a variable"));
            }
            if !operator.verb.is_boolean() || operator.verb == Verb::Not || constant.boolean.is_some() {
                return None;
            }
            unfit(format!("`{}` is no value of type `BOOL`", constant.text))
                .map(|d| d.help("Boolean literals are `TRUE` and `FALSE`, or `1` and `0`"))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::{lines, program};

    #[test]
    fn literals_must_be_boolean_and_cannot_be_written() {
        let text = program("LD 5\nLD 1\nAND( 16#FF\n)\nAND BOOL#TRUE\nST TRUE\nS 0\nST q");
        assert_eq!(lines(Code::OperandUnfit, &text), [2, 4, 7, 8]);
    }
}
