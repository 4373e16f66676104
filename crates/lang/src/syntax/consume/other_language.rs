//! Bodies in the standard's other textual languages: reported once, not line by line.

use pest::iterators::Pair;

use super::{first_word, span};
use crate::syntax::parse::Rule;
use petril_base::source::Span;

/// Words that begin a line of Structured Text and no instruction of IL.
const STRUCTURED_TEXT: [&str; 13] = [
    "IF",
    "ELSIF",
    "ELSE",
    "END_IF",
    "CASE",
    "END_CASE",
    "FOR",
    "END_FOR",
    "WHILE",
    "END_WHILE",
    "REPEAT",
    "UNTIL",
    "END_REPEAT",
];

/// Words that begin a line of a Sequential Function Chart and no instruction of IL.
const CHARTS: [&str; 7] = ["INITIAL_STEP", "STEP", "END_STEP", "TRANSITION", "END_TRANSITION", "ACTION", "END_ACTION"];

/// Language of a body that is clearly not Instruction List, and the line that shows it.
pub fn recognize(body: Pair<'_, Rule>) -> Option<(String, Span)> {
    let lines = body.into_inner().filter(|piece| matches!(piece.as_rule(), Rule::instruction | Rule::bad_line));
    lines.into_iter().find_map(|line| Some((language(&line)?.to_owned(), span(&line))))
}

fn language(line: &Pair<'_, Rule>) -> Option<&'static str> {
    let word = first_word(line).key();
    let word = word.trim_end_matches(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    if STRUCTURED_TEXT.contains(&word) || is_assignment(line) {
        Some("Structured Text")
    } else if CHARTS.contains(&word) {
        Some("a Sequential Function Chart")
    } else {
        None
    }
}

/// Whether a line is an assignment `name := value;`. In Instruction List `:=` stands inside parentheses only, and no
/// `;` ends a parameter.
fn is_assignment(line: &Pair<'_, Rule>) -> bool {
    let left = line.as_str().split_once(":=").map_or("", |(left, _)| left);
    let behind = line.get_input().get(line.as_span().end()..).unwrap_or_default();
    let is_ended = behind.trim_start_matches([' ', '\t']).starts_with(';');
    line.as_rule() == Rule::bad_line && is_ended && !left.is_empty() && !left.contains(['(', ':'])
}
