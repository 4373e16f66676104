//! A constant is given a value. (Without one it is FALSE, which is rarely meant.)
//!
//! Passes: `VAR CONSTANT k : BOOL := TRUE; END_VAR`.
//! Fails: `VAR CONSTANT k : BOOL; END_VAR`.

use super::{Context, Role};
use crate::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let constants = context.symbols.list().iter().filter(|symbol| symbol.role == Some(Role::Constant));
    constants
        .filter(|symbol| symbol.initial.is_none())
        .map(|symbol| {
            let message = format!("the constant `{}` has no value", symbol.name.text);
            Diagnostic::new(Code::ConstantWithoutValue, symbol.name.span, message)
                .help("it is FALSE; write `:= FALSE` if that is meant")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::lines;

    #[test]
    fn a_constant_without_value_is_doubtful() {
        let text = "PROGRAM p VAR CONSTANT\na : BOOL;\nb : BOOL := FALSE;\nEND_VAR VAR\nc : BOOL; END_VAR END_PROGRAM";
        assert_eq!(lines(Code::ConstantWithoutValue, text), [2]);
    }
}
