//! Every operator has as many operands as it takes: none for `NOT`, one for the others.
//!
//! Passes: `LD a`, `NOT`.
//! Fails: `LD`, `AND a, b`, `NOT a`.

use super::Context;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::{Operation, Verb, with_nested};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let instructions = with_nested(&context.pou.body);
    instructions
        .filter_map(|(instruction, _)| {
            let Some(Operation::Simple { operator, operands }) = &instruction.operation else { return None };
            if !operator.verb.is_boolean() {
                return None;
            }
            let takes = usize::from(operator.verb != Verb::Not);
            let count = |span, message: String| Diagnostic::new(Code::OperandCount, span, message);
            match operands.get(takes) {
                None if operands.len() < takes => {
                    let help = format!("write it behind the operator, like `{operator} a`");
                    Some(count(instruction.span, format!("`{operator}` needs an operand")).help(help))
                }
                None => None,
                Some(first) if takes == 0 => Some(
                    count(first.span(), "`NOT` takes no operand".to_owned())
                        .help("it complements the current result; use `LDN` to load a complement"),
                ),
                Some(second) => Some(
                    count(second.span(), format!("`{operator}` takes one operand"))
                        .help("write one instruction for each operand"),
                ),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::{lines, program};

    #[test]
    fn operands_are_counted() {
        let text = program("LD i\nAND i, j\nNOT\nNOT i\nOR\nAND(\nLD\n)\nST q");
        assert_eq!(lines(Code::OperandCount, &text), [3, 5, 6, 8]);
    }
}
