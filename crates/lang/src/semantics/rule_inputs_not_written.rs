//! A program does not write its inputs: they belong to the plant.
//!
//! Passes: `ST memory`, `S output`.
//! Fails: `ST input`, `R input`.

use super::shape::Shape;
use super::{Area, Context, Section, uses};
use crate::syntax::ast::Path;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    writes(context, Section::Input)
        .map(|(path, declared)| {
            let message = format!("the input `{path}` is written");
            Diagnostic::new(Code::InputWritten, path.span, message)
                .also(declared, "declared as an input here")
                .help("declare it in `VAR` or `VAR_OUTPUT` if the program decides its value")
        })
        .collect()
}

/// Written variables of a section, each with its declaration. A variable at `%I…` is an input.
pub(super) fn writes<'a>(context: &Context<'a>, section: Section) -> impl Iterator<Item = (&'a Path, Span)> {
    let mut found = Vec::new();
    for (path, _) in uses::paths(&context.pou.body, Some(context)).into_iter().filter(|(_, writes)| *writes) {
        let Some((declared, _, own)) = context.project.variable(context.id, &path.root.text) else { continue };
        // An external variable has the section of the global one.
        let symbol = match declared {
            Section::External(position) => context.project.globals.list().get(position).unwrap_or(own),
            _ => own,
        };
        let is_instance = matches!(symbol.shape, Some(Shape::Instance(_)));
        let is_input = section == Section::Input && symbol.area() == Some(Area::Input);
        if (symbol.section == section || is_input) && !is_instance {
            found.push((path, symbol.span));
        }
    }
    found.into_iter()
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::{lines, program};
    use petril_base::diagnostic::Code;

    #[test]
    fn writing_an_input_is_refused() {
        let text = program("LD i\nST j\nS i\nAND( m\nSTN j\n)\nR m\nST q");
        assert_eq!(lines(Code::InputWritten, &text), [3, 4, 6]);
    }

    #[test]
    fn an_input_is_not_handed_over_to_be_written() {
        let block = "FUNCTION_BLOCK b VAR_IN_OUT w : BOOL; END_VAR\nLD TRUE\nST w\nEND_FUNCTION_BLOCK";
        let head = "PROGRAM p VAR_INPUT i : BOOL; END_VAR VAR c : b; m : BOOL; END_VAR";
        let text = format!("{block}\n{head}\nCAL c(w := i)\nCAL c(w := m)\nEND_PROGRAM");
        assert_eq!(lines(Code::InputWritten, &text), [6]);
    }
}
