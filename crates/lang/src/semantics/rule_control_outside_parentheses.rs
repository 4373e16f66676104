//! Labels, jumps, returns and calls of function blocks stand outside parentheses and outside the lists of calls (B.2.1:
//! either holds a simple instruction list).
//!
//! Passes: `AND( a`, `OR b`, `)`.
//! Fails: `AND( a`, `JMPC on`, `)`.

use super::Context;
use super::effect::{Leaves, effect};
use crate::syntax::ast::{Operation, with_nested};
use petril_base::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for (instruction, _) in with_nested(&context.pou.body).filter(|&(_, depth)| depth > 0) {
        let mut report = |span, what: &str| {
            let message = format!("{what} stands inside parentheses");
            let help = "store the value so far in a variable, and put it behind the closing parenthesis";
            found.push(Diagnostic::new(Code::ControlInsideParentheses, span, message).help(help));
        };
        if let Some(label) = &instruction.label {
            report(label.span, "a label");
        }
        match &instruction.operation {
            Some(Operation::Jump { .. }) => report(instruction.span, "a jump"),
            Some(Operation::Return { .. }) => report(instruction.span, "a return"),
            Some(Operation::Call { .. }) => report(instruction.span, "a call"),
            Some(Operation::Simple { operator, .. }) if effect(instruction, context).1 == Leaves::Nothing => {
                report(instruction.span, &format!("`{operator}` calls a function block, and"));
            }
            _ => {}
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{lines, program};
    use petril_base::diagnostic::Code;

    #[test]
    fn control_does_not_pass_parentheses() {
        let text = program("on: LD i\nAND( j\na: OR m\nJMPC on\nOR( m\nRET\n)\n)\nJMPC on\nST q");
        assert_eq!(lines(Code::ControlInsideParentheses, &text), [4, 5, 7]);
    }
}
