//! The front door: text to [`Unit`], with every syntax error of the text.

use pest::Parser;
use pest_derive::Parser;

use super::ast::Unit;
use super::{comments, consume, expected};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::{Source, Span};

#[derive(Parser)]
#[grammar = "../grammar/il.pest"]
pub(super) struct IlParser;

/// Reads a text. What cannot be read is reported and left out of the tree, so that the static rules can look at the rest.
#[must_use]
pub fn parse(source: &Source) -> (Unit, Vec<Diagnostic>) {
    let (text, unclosed) = comments::blank(source);
    let mut diagnostics: Vec<Diagnostic> = unclosed.into_iter().collect();
    let unit = match IlParser::parse(Rule::unit, &text) {
        Ok(mut pairs) => pairs.next().map(|pair| consume::unit(pair, &mut diagnostics)).unwrap_or_default(),
        // The grammar reads any text, so this is a limit of the parser itself.
        Err(error) => {
            diagnostics.push(expected::diagnostic(&error, &text, 0));
            Unit::default()
        }
    };
    if unit.pous.is_empty() && diagnostics.is_empty() {
        let end = source.text().trim_end().len();
        diagnostics.push(
            Diagnostic::new(Code::NothingToCheck, Span::new(end, end), "this file holds no program")
                .help("write the instructions between `PROGRAM name` and `END_PROGRAM`"),
        );
    }
    diagnostics.sort_by_key(Diagnostic::span);
    (unit, diagnostics)
}
