//! Every initial value is a literal of the variable's type.
//!
//! Passes: `a : BOOL := TRUE;`, `a : BOOL := 1;`.
//! Fails: `a : BOOL := 2;`, `a : BOOL := b;`.

use super::Context;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::key;

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let declarations = context.pou.blocks.iter().flat_map(|block| &block.declarations);
    // Where the type is not supported, nothing can be said of the value.
    let boolean = declarations.filter(|d| d.type_text.as_ref().is_some_and(|t| key(&t.text) == "BOOL"));
    boolean
        .filter_map(|declaration| declaration.initial.as_ref())
        .filter(|initial| initial.boolean.is_none())
        .map(|initial| {
            let message = format!("`{}` is no value of type `BOOL`", initial.text);
            Diagnostic::new(Code::InitialValueUnfit, initial.span, message).help("write `TRUE` or `FALSE`")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::lines;

    #[test]
    fn only_boolean_literals_are_values() {
        let text = "PROGRAM p VAR\na : BOOL := 2;\nb : BOOL := BOOL#1;\nc : BOOL := a;\nd : BOOL := false;\n\
                    e : INT := 2; END_VAR END_PROGRAM";
        assert_eq!(lines(Code::InitialValueUnfit, text), [2, 4]);
    }
}
