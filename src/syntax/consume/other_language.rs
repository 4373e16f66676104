//! Bodies in the standard's other textual languages: one thing to say of them, not one for each line.

use pest::iterators::Pair;

use super::{first_word, span};
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::parse::Rule;

/// Words that begin a line of Structured Text and no instruction.
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

/// The same for Sequential Function Charts.
const CHARTS: [&str; 7] = ["INITIAL_STEP", "STEP", "END_STEP", "TRANSITION", "END_TRANSITION", "ACTION", "END_ACTION"];

/// Reports the first line of a body that is clearly of another language.
pub fn refuse(body: Pair<'_, Rule>) -> Option<Diagnostic> {
    let lines = body.into_inner().filter(|piece| matches!(piece.as_rule(), Rule::instruction | Rule::bad_line));
    lines.into_iter().find_map(|line| refuse_line(&line))
}

fn refuse_line(line: &Pair<'_, Rule>) -> Option<Diagnostic> {
    let word = first_word(line).key();
    let word = word.trim_end_matches(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    let (language, help) = if STRUCTURED_TEXT.contains(&word) || is_assignment(line) {
        ("Structured Text", "only Instruction List is read: instead of `q := a AND b;` write `LD a`, `AND b`, `ST q`")
    } else if CHARTS.contains(&word) {
        ("a Sequential Function Chart", "only Instruction List is read")
    } else {
        return None;
    };
    let message = format!("this is {language}, not Instruction List");
    Some(Diagnostic::new(Code::Syntax, span(line), message).help(help))
}

/// `name := value`; in Instruction List `:=` stands inside parentheses only.
fn is_assignment(line: &Pair<'_, Rule>) -> bool {
    let left = line.as_str().split_once(":=").map_or("", |(left, _)| left);
    line.as_rule() == Rule::bad_line && !left.is_empty() && !left.contains(['(', ':'])
}
