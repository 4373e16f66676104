//! Every label is jumped to.
//!
//! Passes: `JMP on` … `on: LD a`.
//! Fails: `on: LD a` without a jump to it.

use std::collections::BTreeSet;

use super::{Context, control_flow};
use crate::syntax::ast::{Operation, with_nested};
use petril_base::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let body = &context.pou.body;
    if !control_flow::is_known(body) {
        return Vec::new();
    }
    let used: BTreeSet<String> = with_nested(body)
        .filter_map(|(instruction, _)| match &instruction.operation {
            Some(Operation::Jump { target, .. }) => Some(target.key()),
            _ => None,
        })
        .collect();
    let labels = body.iter().filter_map(|instruction| instruction.label.as_ref());
    labels
        .filter(|label| !used.contains(&label.key()))
        .map(|label| {
            let message = format!("nothing jumps to the label `{}`", label.text);
            Diagnostic::new(Code::LabelNotUsed, label.span, message)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{lines, program};
    use petril_base::diagnostic::Code;

    #[test]
    fn a_label_without_jump_is_doubtful() {
        let text = program("a: LD i\nJMPC B\nb: ST q");
        assert_eq!(lines(Code::LabelNotUsed, &text), [2]);
    }

    #[test]
    fn nothing_is_doubted_while_a_jump_has_no_label() {
        let text = program("LD i\nJMP en\nend: ST q");
        assert_eq!(lines(Code::LabelNotUsed, &text), [0; 0]);
        assert_eq!(lines(Code::InstructionUnreachable, &text), [0; 0]);
        let text = program("LD i\nJMP end!\nend: ST q");
        assert_eq!(lines(Code::LabelNotUsed, &text), [0; 0]);
    }
}
