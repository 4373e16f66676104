//! Every variable is used: one that is read is written or has a value, and every output is written.
//!
//! Passes: `VAR a : BOOL; END_VAR`, `ST a`, `LD a`.
//! Fails: `a` occurs nowhere; `a` is loaded and nothing ever stores in it; nothing stores in the output `q`.

use std::collections::BTreeMap;

use super::shape::Shape;
use super::symbols::Symbol;
use super::{Area, Context, Section, uses};
use crate::syntax::ast::key;
use petril_base::diagnostic::{Code, Diagnostic};

pub fn apply(context: &Context<'_>) -> Vec<Diagnostic> {
    // For each variable that occurs, whether it is written.
    let mut written: BTreeMap<String, bool> = BTreeMap::new();
    for (path, writes) in uses::paths(&context.pou.body, Some(context)) {
        let by_address = context.symbols.find(&path.root.text).map(|(_, symbol)| key(&symbol.name));
        *written.entry(by_address.unwrap_or_else(|| path.root.key())).or_default() |= writes;
    }
    context
        .symbols
        .list()
        .iter()
        .filter_map(|symbol| complaint(symbol, written.get(&key(&symbol.name)).copied()))
        .collect()
}

fn complaint(symbol: &Symbol, written: Option<bool>) -> Option<Diagnostic> {
    symbol.shape.as_ref()?;
    let name = &symbol.name;
    let is_input = symbol.section == Section::Input || symbol.area() == Some(Area::Input);
    let is_instance = matches!(symbol.shape, Some(Shape::Instance(_)));
    let is_output = symbol.section == Section::Output || symbol.area() == Some(Area::Output);
    match written {
        None | Some(false) if is_output && !symbol.is_given => {
            let message = format!("the output `{name}` is never written");
            Some(
                Diagnostic::new(Code::OutputNotWritten, symbol.span, message)
                    .help("it keeps its initial value for ever"),
            )
        }
        None | Some(false) if symbol.section == Section::Result => {
            let message = format!("the function `{name}` never gives its result a value");
            Some(
                Diagnostic::new(Code::OutputNotWritten, symbol.span, message)
                    .help(format!("store it with `ST {name}`")),
            )
        }
        None if is_output || matches!(symbol.section, Section::Constant | Section::External(_)) => None,
        None => {
            let message = format!("`{name}` is never used");
            let help = "use it, or remove its declaration";
            Some(Diagnostic::new(Code::VariableNotUsed, symbol.span, message).help(help))
        }
        Some(false) if symbol.section == Section::Local && !is_input && !is_instance && !symbol.is_given => {
            if !matches!(symbol.shape, Some(Shape::Scalar(_))) {
                return None;
            }
            let message = format!("`{name}` is read, but never written");
            let help = "it keeps its initial value for ever; is it an input, or was an `ST` forgotten?";
            Some(Diagnostic::new(Code::VariableNotWritten, symbol.span, message).help(help))
        }
        Some(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::semantics::testing::lines;
    use petril_base::diagnostic::Code;

    #[test]
    fn variables_are_read_and_written() {
        let text = "PROGRAM p\nVAR_INPUT\ni : BOOL;\nunused : BOOL;\nEND_VAR\nVAR\nread : BOOL;\nset : BOOL := TRUE;\n\
                    END_VAR\nVAR_OUTPUT\nq : BOOL;\nr : BOOL;\nEND_VAR\nLD i\nAND read\nAND set\nST q\nEND_PROGRAM";
        assert_eq!(lines(Code::VariableNotUsed, text), [4]);
        assert_eq!(lines(Code::VariableNotWritten, text), [7]);
        assert_eq!(lines(Code::OutputNotWritten, text), [12]);
    }
}
