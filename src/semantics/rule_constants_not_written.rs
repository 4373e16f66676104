//! A program does not write its constants.
//!
//! Passes: `LD constant`.
//! Fails: `ST constant`.

use super::{Context, Section};
use crate::diagnostic::{Code, Diagnostic};
use crate::semantics::rule_inputs_not_written::writes;

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    writes(context, Section::Constant)
        .map(|(path, declared)| {
            let message = format!("the constant `{path}` is written");
            Diagnostic::new(Code::ConstantWritten, path.span, message)
                .also(declared, "declared as a constant here")
                .help("declare it in `VAR` if it changes")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::{lines, program};

    #[test]
    fn writing_a_constant_is_refused() {
        let text = program("LD k\nST q\nST k\nR K");
        assert_eq!(lines(Code::ConstantWritten, &text), [4, 5]);
    }
}
