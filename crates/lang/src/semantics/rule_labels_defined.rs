//! Every jump goes to a label of the same instruction list, outside parentheses. A label that does not exist is reported at
//! the first jump to it.
//!
//! Passes: `JMP on` … `on: LD a`.
//! Fails: `JMP off` where there is no `off:`.

use std::collections::BTreeSet;

use super::{Context, control_flow};
use crate::syntax::ast::{Operation, with_nested};
use petril_base::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let body = &context.pou.body;
    let labels = control_flow::labels(body);
    let spellings = || body.iter().filter_map(|instruction| instruction.label.as_ref()).map(|name| name.text.as_str());
    let jumps = with_nested(body).filter_map(|(instruction, _)| match &instruction.operation {
        Some(Operation::Jump { target, .. }) => Some(target),
        _ => None,
    });
    let mut reported = BTreeSet::new();
    jumps
        .filter(|target| !labels.contains_key(&target.key()) && reported.insert(target.key()))
        .enumerate()
        .map(|(i, target)| {
            let message = format!("there is no label `{}` to jump to", target.text);
            Diagnostic::new(Code::LabelNotDefined, target.span, message).suggest_at(i, &target.text, spellings())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{lines, program};
    use petril_base::diagnostic::Code;

    #[test]
    fn a_jump_needs_its_label() {
        let text = program("LD i\nJMPC on\nJMP of\nON: ST q\noff:");
        assert_eq!(lines(Code::LabelNotDefined, &text), [4]);
    }

    #[test]
    fn a_label_is_missed_once() {
        assert_eq!(lines(Code::LabelNotDefined, &program("LD i\nJMPC on\nJMPC ON\nJMP off")), [3, 5]);
    }

    #[test]
    fn a_label_inside_parentheses_is_no_target() {
        let text = program("LD i\nJMPC in\nAND( j\nin: OR m\n)\nST q");
        assert_eq!(lines(Code::LabelNotDefined, &text), [3]);
    }
}
