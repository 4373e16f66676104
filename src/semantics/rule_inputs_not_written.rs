//! A program does not write its inputs: they belong to the plant.
//!
//! Passes: `ST memory`, `S output`.
//! Fails: `ST input`, `R input`.

use super::{Context, Role};
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::{Name, Operand, Operation, Verb, with_nested};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    writes(context, Role::Input)
        .map(|(name, declared)| {
            let message = format!("the input `{}` is written", name.text);
            Diagnostic::new(Code::InputWritten, name.span, message)
                .also(declared, "declared as an input here")
                .help("declare it in `VAR` or `VAR_OUTPUT` if the program decides its value")
        })
        .collect()
}

/// The operands that are written although they have this role, each with its declaration.
pub(super) fn writes<'a>(
    context: &'a Context<'_>,
    role: Role,
) -> impl Iterator<Item = (&'a Name, crate::source::Span)> {
    with_nested(&context.pou.body).filter_map(move |(instruction, _)| {
        let Some(Operation::Simple { operator, operands }) = &instruction.operation else { return None };
        let Some(Operand::Variable(name)) = operands.first() else { return None };
        let (_, symbol) = context.symbols.find(&name.text)?;
        let writes = matches!(operator.verb, Verb::St | Verb::S | Verb::R);
        (writes && symbol.role == Some(role)).then_some((name, symbol.name.span))
    })
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Code;
    use crate::semantics::testing::{lines, program};

    #[test]
    fn writing_an_input_is_refused() {
        let text = program("LD i\nST j\nS i\nAND( m\nSTN j\n)\nR m\nST q");
        assert_eq!(lines(Code::InputWritten, &text), [3, 4, 6]);
    }
}
