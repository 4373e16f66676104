//! Every jump goes to a label of the same instruction list, outside parentheses.
//!
//! Passes: `JMP on` … `on: LD a`.
//! Fails: `JMP off` where there is no `off:`.

use super::{Context, control_flow};
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::{Operation, with_nested};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let body = &context.pou.body;
    let labels = control_flow::labels(body);
    let spellings = || body.iter().filter_map(|instruction| instruction.label.as_ref()).map(|name| name.text.as_str());
    let jumps = with_nested(body).filter_map(|(instruction, _)| match &instruction.operation {
        Some(Operation::Jump { target, .. }) => Some(target),
        _ => None,
    });
    jumps
        .filter(|target| !labels.contains_key(&target.key()))
        .map(|target| {
            let message = format!("there is no label `{}` to jump to", target.text);
            Diagnostic::new(Code::LabelNotDefined, target.span, message).suggest(&target.text, spellings())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::{lines, program};

    #[test]
    fn a_jump_needs_its_label() {
        let text = program("LD i\nJMPC on\nJMP of\nON: ST q\noff:");
        assert_eq!(lines(Code::LabelNotDefined, &text), [4]);
    }

    #[test]
    fn a_label_inside_parentheses_is_no_target() {
        let text = program("LD i\nJMPC in\nAND( j\nin: OR m\n)\nST q");
        assert_eq!(lines(Code::LabelNotDefined, &text), [3]);
    }
}
