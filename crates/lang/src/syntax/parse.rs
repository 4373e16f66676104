//! Parsing of a text to a [`Unit`], with every syntax error of the text.

use pest::Parser;
use pest_derive::Parser;

use super::ast::Unit;
use super::{comments, consume, dialect, expected, nesting, plcopen};
use petril_base::diagnostic::{Code, Diagnostic, any_error};
use petril_base::source::{Source, Span};

#[derive(Parser)]
#[grammar = "../../grammar/il.pest"]
pub(super) struct IlParser;

/// Parses a text, or a PLCopen project in XML. Whatever cannot be read is reported and left out of the tree, so that
/// the static rules can check the rest.
#[must_use]
pub fn parse(source: &Source) -> (Unit, Vec<Diagnostic>) {
    if plcopen::is_xml(source) {
        return plcopen::read(source);
    }
    let (text, unclosed) = comments::blank(source.text(), 0);
    if let Some(unclosed) = unclosed {
        // An open comment hides what follows, and everything hidden would be missing: only its opening is reported.
        return (Unit::default(), vec![unclosed]);
    }
    if let Some(too_deep) = nesting::too_deep(&text, 0) {
        return (Unit::default(), vec![too_deep]);
    }
    if let Some(other) = dialect::statement_list(&text) {
        return (Unit::default(), vec![other]);
    }
    let mut diagnostics = Vec::new();
    let unit = match IlParser::parse(Rule::unit, &text) {
        Ok(mut pairs) => pairs.next().map(|pair| consume::unit(pair, &mut diagnostics)).unwrap_or_default(),
        // The grammar accepts any text, so the error is a limit of the parser itself.
        Err(error) => {
            diagnostics.push(expected::diagnostic(&error, &text, 0));
            Unit::default()
        }
    };
    if unit.pous.is_empty() && !any_error(&diagnostics) {
        let end = source.text().trim_end().len();
        diagnostics.push(
            Diagnostic::new(Code::NothingToCheck, Span::new(end, end), "this file holds no program")
                .help("write the instructions between `PROGRAM name` and `END_PROGRAM`"),
        );
    }
    diagnostics.sort_by_key(Diagnostic::span);
    (unit, diagnostics)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_open_comment_is_one_mistake() {
        let (_, diagnostics) = parse(&Source::new("x", "PROGRAM p\nLD = 3\nJMP on (* \non: LD a\nEND_PROGRAM"));
        let codes: Vec<Code> = diagnostics.iter().map(|diagnostic| diagnostic.code).collect();
        assert_eq!(codes, [Code::CommentNotClosed]);
    }
}
