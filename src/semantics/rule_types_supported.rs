//! Every variable is of a type that has a meaning here, which is `BOOL`.
//!
//! Passes: `x : BOOL;`.
//! Fails: `x : INT;`.

use super::Context;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::key;

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let declarations = context.pou.blocks.iter().flat_map(|block| &block.declarations);
    let types = declarations.filter_map(|declaration| declaration.type_text.as_ref());
    types
        .filter(|written| key(&written.text) != "BOOL")
        .map(|written| {
            let message = format!("the type `{}` is not supported", written.text);
            Diagnostic::new(Code::TypeNotSupported, written.span, message)
                .help("this version models variables of type `BOOL`")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::lines;

    #[test]
    fn only_bool_is_modelled() {
        let text = "PROGRAM p VAR\na : bool;\nb : INT;\nc : ARRAY[0..3] OF BOOL;\nEND_VAR END_PROGRAM";
        assert_eq!(lines(Code::TypeNotSupported, text), [3, 4]);
    }
}
