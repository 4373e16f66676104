//! A parenthesis begins with a value: an operand behind `(`, or a load as its first instruction.
//!
//! Passes: `AND( a` … `)`; `AND(`, `LD a` … `)`.
//! Fails: `AND(`, `OR a`, `)`; `AND(`, `)`.

use super::Context;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::{Instruction, Operation, Verb, with_nested};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    // Of parentheses that begin with one another, the outermost is reported: `AND(AND(AND(` is one mistake.
    let mut reported: Option<&Instruction> = None;
    with_nested(&context.pou.body)
        .filter_map(|(instruction, _)| {
            let Some(Operation::Parenthesis { operator, first: None, body, close }) = &instruction.operation else {
                return None;
            };
            let unvalued = |span, message: String| {
                Diagnostic::new(Code::ParenthesisWithoutValue, span, message)
                    .also(instruction.span, "the parenthesis opens here")
                    .help(format!("begin with `{operator}( a` or with `LD a`"))
            };
            match body.first() {
                None => Some(unvalued(*close, "this parenthesis is empty".to_owned())),
                Some(first) if begins_with_value(first) || is_broken(first) => None,
                Some(first) => {
                    if reported.replace(first).is_some_and(|outer| std::ptr::eq(outer, instruction)) {
                        return None;
                    }
                    let message = "the parenthesis has no value yet when this instruction uses it";
                    Some(unvalued(first.span, message.to_owned()))
                }
            }
        })
        .collect()
}

/// A load; calls and control are reported by other rules.
fn begins_with_value(instruction: &Instruction) -> bool {
    match &instruction.operation {
        Some(Operation::Simple { operator, .. }) => operator.verb == Verb::Ld,
        Some(Operation::Function { arguments, .. }) => arguments.enclosed,
        Some(Operation::Parenthesis { .. }) => false,
        _ => true,
    }
}

/// Whether what a parenthesis begins with, after however many more, could not be read.
fn is_broken(mut first: &Instruction) -> bool {
    loop {
        match &first.operation {
            Some(Operation::Parenthesis { first: None, body, .. }) => match body.first() {
                Some(inner) => first = inner,
                None => return false,
            },
            operation => return matches!(operation, Some(Operation::Broken)),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::{lines, program};

    #[test]
    fn a_parenthesis_needs_a_first_value() {
        let text = program("LD i\nAND( j\n)\nAND(\nLDN j\n)\nAND(\nOR j\n)\nAND(\n)\nAND(\nAND( j\n)\n)\nST q");
        assert_eq!(lines(Code::ParenthesisWithoutValue, &text), [9, 12, 14]);
    }

    #[test]
    fn a_chain_of_parentheses_is_one_mistake() {
        let text = program("LD i\nAND(\nAND(\nAND(\nOR( j\n)\n)\n)\nAND(\nOR m\n)\n)\nST q");
        assert_eq!(lines(Code::ParenthesisWithoutValue, &text), [4, 11]);
    }
}
