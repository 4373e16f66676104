//! A parenthesis begins with a value: an operand after `(`, or a load as its first instruction. So does a list in a
//! call.
//!
//! Passes: `AND( a` … `)`; `AND(`, `LD a` … `)`.
//! Fails: `AND(`, `OR a`, `)`; `AND(`, `)`; `CAL t(IN := (` `AND a` … `))`.

use std::collections::BTreeSet;

use super::Context;
use crate::syntax::ast::{Instruction, Operation, Verb, with_nested};
use petril_base::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    // Of nested parentheses that begin with one another, the outermost is reported: `AND(AND(AND(` is one mistake.
    let mut reported = BTreeSet::new();
    for (instruction, _) in with_nested(&context.pou.body) {
        match &instruction.operation {
            Some(Operation::Parenthesis { first: Some(_), .. }) => {}
            Some(Operation::Parenthesis { operator, first: None, body, close }) => {
                let unvalued = |span, message: &str| {
                    Diagnostic::new(Code::ParenthesisWithoutValue, span, message)
                        .also(instruction.span, "the parenthesis opens here")
                        .help(format!("begin with `{operator}( a` or with `LD a`"))
                };
                match body.first() {
                    None => found.push(unvalued(*close, "this parenthesis is empty")),
                    Some(first) if begins_with_value(first) || is_broken(first) => {}
                    Some(first) => {
                        reported.insert(first.span);
                        if !reported.contains(&instruction.span) {
                            let message = "the parenthesis has no value yet when this instruction uses it";
                            found.push(unvalued(first.span, message));
                        }
                    }
                }
            }
            _ => {
                for first in instruction.lists().into_iter().filter_map(<[_]>::first).filter(|i| !begins_with_value(i))
                {
                    reported.insert(first.span);
                    let message = "the list has no value yet when this instruction uses it";
                    let diagnostic = Diagnostic::new(Code::ParenthesisWithoutValue, first.span, message);
                    found.push(diagnostic.help("begin it with `LD`"));
                }
            }
        }
    }
    found
}

/// Whether an instruction is a load or a formal call; calls and control are reported by other rules.
fn begins_with_value(instruction: &Instruction) -> bool {
    match &instruction.operation {
        Some(Operation::Simple { operator, .. }) => operator.verb == Verb::Ld,
        Some(Operation::Function { arguments, .. }) => arguments.enclosed,
        Some(Operation::Parenthesis { .. }) => false,
        _ => true,
    }
}

/// Whether the innermost first instruction of a parenthesis could not be read.
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
    use crate::semantics::testing::{lines, program};
    use petril_base::diagnostic::Code;

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
