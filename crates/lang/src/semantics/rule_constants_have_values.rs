//! A constant is given a value. (Without one it has the default of its type, which is rarely meant.)
//!
//! Passes: `VAR CONSTANT k : BOOL := TRUE; END_VAR`.
//! Fails: `VAR CONSTANT k : BOOL; END_VAR`.

use super::{Context, Section};
use petril_base::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let constants = context.symbols.list().iter().filter(|symbol| symbol.section == Section::Constant);
    constants
        .filter(|symbol| !symbol.is_given)
        .map(|symbol| {
            let message = format!("the constant `{}` has no value", symbol.name);
            let is_bool =
                symbol.shape.as_ref().and_then(|shape| shape.scalar()).is_some_and(|scalar| scalar.ty.is_bool());
            let zero = if is_bool { "FALSE" } else { "0" };
            Diagnostic::new(Code::ConstantWithoutValue, symbol.span, message)
                .help(format!("it is {zero}; write `:= {zero}` if that is meant"))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::lines;
    use petril_base::diagnostic::Code;

    #[test]
    fn a_constant_without_value_is_doubtful() {
        let text = "PROGRAM p VAR CONSTANT\na : BOOL;\nb : BOOL := FALSE;\nEND_VAR VAR\nc : BOOL; END_VAR END_PROGRAM";
        assert_eq!(lines(Code::ConstantWithoutValue, text), [2]);
    }
}
