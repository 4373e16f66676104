//! No name is declared twice. `Step` and `STEP` are the same name.
//!
//! Passes: `a, b : BOOL;`.
//! Fails: `a : BOOL; A : BOOL;`.

use super::Context;
use crate::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    let declarations = context.pou.blocks.iter().flat_map(|block| &block.declarations);
    // Of a declaration that cannot be read, nobody knows which words are names.
    let readable = declarations.filter(|declaration| declaration.type_text.is_some());
    let names = readable.flat_map(|declaration| &declaration.names);
    names
        .filter_map(|name| {
            let (_, first) = context.symbols.find(&name.text)?;
            if first.name.span == name.span {
                return None;
            }
            let message = format!("`{}` is declared twice", name.text);
            let again = Diagnostic::new(Code::NameDeclaredTwice, name.span, message).here("declared again");
            Some(again.also(first.name.span, "first declared here").help("remove or rename one of them"))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::lines;

    #[test]
    fn the_second_declaration_is_reported() {
        let text = "PROGRAM p VAR\na, b : BOOL;\nEND_VAR VAR_INPUT\nA : BOOL;\nEND_VAR END_PROGRAM";
        assert_eq!(lines(Code::NameDeclaredTwice, text), [4]);
    }

    #[test]
    fn a_declaration_that_cannot_be_read_declares_nothing_twice() {
        let text = "PROGRAM p VAR\na : BOOL;\na b;\na b;\nEND_VAR END_PROGRAM";
        assert_eq!(lines(Code::NameDeclaredTwice, text), [0; 0]);
        assert_eq!(lines(Code::Syntax, text), [3, 4]);
    }
}
