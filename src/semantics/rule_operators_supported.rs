//! Every instruction is one whose meaning is modelled.
//!
//! Passes: the Boolean operators, jumps and returns.
//! Fails: `ADD 1`, `CAL timer`, `LIMIT a, b, c`; `LDX a`, which is nothing at all.

use super::Context;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::{Instruction, Name, Operation, Verb, with_nested};

/// The words an instruction of this version can begin with.
const WORDS: [&str; 20] = [
    "LD", "LDN", "ST", "STN", "S", "R", "NOT", "AND", "ANDN", "OR", "ORN", "XOR", "XORN", "&", "JMP", "JMPC", "JMPCN",
    "RET", "RETC", "RETCN",
];

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    with_nested(&context.pou.body).filter_map(|(instruction, _)| refusal(instruction, context)).collect()
}

fn refusal(instruction: &Instruction, context: &Context<'_>) -> Option<Diagnostic> {
    let unsupported = |message: String, help: &str| {
        Some(Diagnostic::new(Code::OperatorNotSupported, instruction.span, message).help(help))
    };
    match instruction.operation.as_ref()? {
        Operation::Simple { operator, .. } | Operation::Parenthesis { operator, .. } if !operator.verb.is_boolean() => {
            let help = match operator.verb {
                Verb::S1 | Verb::R1 | Verb::Clk | Verb::Cu | Verb::Cd | Verb::Pv | Verb::In | Verb::Pt => {
                    "it calls a function block, and this version models none"
                }
                _ => "it needs numbers, and this version models variables of type `BOOL`",
            };
            unsupported(format!("the operator `{operator}` is not supported"), help)
        }
        Operation::Call { callee } => unsupported(
            format!("the call of `{}` is not supported", callee.text),
            "this version models programs without function blocks",
        ),
        Operation::Function { name } if is_function(name, context) => unsupported(
            format!("the call of function `{}` is not supported", name.text),
            "this version models programs without functions",
        ),
        Operation::Function { name } => {
            let message = format!("`{}` is neither an operator nor a function of this file", name.text);
            Some(Diagnostic::new(Code::UnknownOperator, name.span, message).suggest(&name.text, WORDS))
        }
        _ => None,
    }
}

/// A function of this file, or an operator's word used as one.
fn is_function(name: &Name, context: &Context<'_>) -> bool {
    let defined = context.unit.pous.iter().any(|pou| pou.name.key() == name.key());
    defined || Verb::ALL.iter().any(|(_, word)| *word == name.key())
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::{lines, program};

    #[test]
    fn what_is_not_modelled_is_refused_by_name() {
        let text = program("LD i\nADD 1\nGT( 3\n)\nCAL t(IN := i)\nCLK t\nAND(IN1 := i, IN2 := j)\nMUX i, j\nST q");
        assert_eq!(lines(Code::OperatorNotSupported, &text), [3, 4, 6, 7, 8]);
        assert_eq!(lines(Code::UnknownOperator, &text), [9]);
    }

    #[test]
    fn functions_of_the_file_are_known() {
        let text = format!("{}\nFUNCTION f : BOOL\nLD TRUE\nST f\nEND_FUNCTION", program("LD i\nf j\nST q"));
        assert_eq!(lines(Code::OperatorNotSupported, &text), [3]);
        assert_eq!(lines(Code::PouNotChecked, &text), [6]);
    }
}
