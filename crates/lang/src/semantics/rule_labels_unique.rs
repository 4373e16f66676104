//! A label is defined once.
//!
//! Passes: `a: LD x` … `b: LD x`.
//! Fails: `a: LD x` … `A: LD x`.

use std::collections::BTreeMap;

use super::Context;
use crate::syntax::ast::with_nested;
use petril_base::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let mut first = BTreeMap::new();
    let labels = with_nested(&context.pou.body).filter_map(|(instruction, _)| instruction.label.as_ref());
    labels
        .filter_map(|label| {
            let earlier = *first.entry(label.key()).or_insert(label.span);
            (earlier != label.span).then(|| {
                let message = format!("the label `{}` is defined twice", label.text);
                Diagnostic::new(Code::LabelDefinedTwice, label.span, message)
                    .here("defined again")
                    .also(earlier, "first defined here")
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{lines, program};
    use petril_base::diagnostic::Code;

    #[test]
    fn the_second_definition_is_reported() {
        let text = program("a: LD i\nb:\nA: ST q\nJMP b");
        assert_eq!(lines(Code::LabelDefinedTwice, &text), [4]);
    }
}
