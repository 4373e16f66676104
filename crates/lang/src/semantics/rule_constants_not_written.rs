//! A program does not write its constants.
//!
//! Passes: `LD constant`.
//! Fails: `CAL block(in_out := constant)`; `ST constant`.

use super::{Context, Section};
use crate::semantics::rule_inputs_not_written::writes;
use petril_base::diagnostic::{Code, Diagnostic};

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
    use crate::semantics::testing::{lines, program};
    use petril_base::diagnostic::Code;

    #[test]
    fn writing_a_constant_is_refused() {
        let text = program("LD k\nST q\nST k\nR K");
        assert_eq!(lines(Code::ConstantWritten, &text), [4, 5]);
    }

    #[test]
    fn a_block_may_write_what_its_in_out_variables_stand_for() {
        let block =
            "FUNCTION_BLOCK b VAR_INPUT x : BOOL; END_VAR VAR_IN_OUT w : BOOL; END_VAR\nLD x\nST w\nEND_FUNCTION_BLOCK";
        let head = "PROGRAM p VAR CONSTANT k : BOOL := TRUE; END_VAR VAR c : b; m : BOOL; END_VAR";
        let text = format!("{block}\n{head}\nCAL c(w := k)\nCAL c(k, k)\nCAL c(x := k, w := m)\nEND_PROGRAM");
        assert_eq!(lines(Code::ConstantWritten, &text), [6, 7]);
        let function = "FUNCTION f : BOOL VAR_INPUT x : BOOL; END_VAR VAR_IN_OUT w : BOOL; END_VAR\nLD x\nST w\nST f\nEND_FUNCTION";
        let text =
            format!("{function}\n{}\nf(x := m, w := k)\nLD k\nf k\nf m\nEND_PROGRAM", head.replace("c : b; ", ""));
        assert_eq!(lines(Code::ConstantWritten, &text), [7, 9]);
    }
}
