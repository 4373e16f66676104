//! Every declaration is of a kind that has a meaning here.
//!
//! Passes: `VAR`, `VAR_INPUT`, `VAR_OUTPUT`, `VAR CONSTANT`.
//! Fails: `VAR_EXTERNAL x : BOOL; END_VAR`; `VAR x AT %IX0.0 : BOOL; END_VAR`; `VAR RETAIN x : BOOL; END_VAR`.

use super::Context;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::VarKind;

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for block in &context.pou.blocks {
        let unsupported = |span, what: String| {
            Diagnostic::new(Code::DeclarationNotSupported, span, format!("{what} is not supported"))
        };
        match block.kind {
            VarKind::Input | VarKind::Output if block.constant => found.push(
                unsupported(block.span, format!("a constant `{}`", block.kind)).help("declare it in `VAR CONSTANT`"),
            ),
            VarKind::Local | VarKind::Input | VarKind::Output => {}
            kind => found.push(
                unsupported(block.span, format!("`{kind}` in a program"))
                    .help("declare inputs, outputs and memory in `VAR_INPUT`, `VAR_OUTPUT` and `VAR`"),
            ),
        }
        if let Some(retain) = block.retain.as_ref().filter(|word| word.key() == "RETAIN") {
            found
                .push(unsupported(retain.span, "`RETAIN`".to_owned()).help(
                    "only a cold start is modelled, where every variable has its initial value; remove the word",
                ));
        }
        for location in block.declarations.iter().filter_map(|declaration| declaration.location.as_ref()) {
            found.push(
                unsupported(location.span, format!("the address `{}`", location.text))
                    .help("remove `AT …`, and declare the variable in `VAR_INPUT` or `VAR_OUTPUT`"),
            );
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::lines;

    #[test]
    fn kinds_without_meaning_are_refused() {
        let text = "PROGRAM p\nVAR_EXTERNAL\na : BOOL; END_VAR\nVAR b AT %IX0.0 : BOOL; END_VAR\n\
                    VAR RETAIN c : BOOL; END_VAR\nVAR_INPUT CONSTANT d : BOOL; END_VAR\nEND_PROGRAM";
        assert_eq!(lines(Code::DeclarationNotSupported, text), [2, 4, 5, 6]);
        let fine = "PROGRAM p VAR NON_RETAIN b : BOOL; END_VAR VAR CONSTANT c : BOOL := 1; END_VAR END_PROGRAM";
        assert_eq!(lines(Code::DeclarationNotSupported, fine), [0; 0]);
    }
}
