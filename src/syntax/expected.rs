//! What the grammar expected, in the words of the language instead of rule names.

use pest::Parser;
use pest::error::{Error, ErrorVariant, InputLocation};

use super::parse::{IlParser, Rule};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// Reads a piece of text again by the rule that should have read it, and says why that fails. `start` is the piece's
/// offset in the whole text.
pub fn explain(rule: Rule, text: &str, start: usize) -> Diagnostic {
    match IlParser::parse(rule, text) {
        Err(error) => diagnostic(&error, start),
        Ok(_) => {
            let span = Span::new(start, start + text.len());
            Diagnostic::new(Code::Syntax, span, "this cannot stand here")
        }
    }
}

/// A pest error as a diagnostic.
pub fn diagnostic(error: &Error<Rule>, start: usize) -> Diagnostic {
    let at = match error.location {
        InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
    };
    let rest = error.line().get(column(error)..).unwrap_or("");
    let found = rest.split_whitespace().next().map_or_else(|| "the end of the line".to_owned(), |w| format!("`{w}`"));
    let width = rest.split_whitespace().next().map_or(0, str::len);
    let span = Span::new(start + at, start + at + width);
    match &error.variant {
        ErrorVariant::ParsingError { positives, .. } => {
            let mut names: Vec<&str> = positives.iter().filter_map(|&rule| name(rule)).collect();
            names.dedup();
            let message = match names.split_last() {
                None => format!("{found} cannot stand here"),
                Some((last, [])) => format!("expected {last}, found {found}"),
                Some((last, others)) => format!("expected {} or {last}, found {found}", others.join(", ")),
            };
            Diagnostic::new(Code::Syntax, span, message)
        }
        ErrorVariant::CustomError { message } => Diagnostic::new(Code::Syntax, span, message.clone()),
    }
}

/// Byte offset of the error in its line.
fn column(error: &Error<Rule>) -> usize {
    let (pest::error::LineColLocation::Pos((_, column)) | pest::error::LineColLocation::Span((_, column), _)) =
        error.line_col;
    error.line().char_indices().nth(column - 1).map_or(error.line().len(), |(i, _)| i)
}

fn name(rule: Rule) -> Option<&'static str> {
    Some(match rule {
        Rule::EOI | Rule::eol => "the end of the line",
        Rule::identifier => "a name",
        Rule::operand | Rule::constant | Rule::variable | Rule::symbolic_variable => "an operand",
        Rule::operator | Rule::expr_operator | Rule::instruction => "an instruction",
        Rule::label => "a label",
        Rule::type_text | Rule::result_type => "a type",
        Rule::initial | Rule::other_initial => "an initial value",
        Rule::colon => "`:`",
        Rule::assign => "`:=`",
        Rule::semicolon => "`;`",
        Rule::direct_variable => "an address like `%IX0.0`",
        Rule::declaration => "a declaration like `a : BOOL;`",
        Rule::argument | Rule::arguments => "a parameter",
        _ => return None,
    })
}
