//! Conversion of pest's pairs to declarations; rejects what a place/transition net does not have.

use pest::iterators::Pair;

use super::expected;
use super::read::Rule;
use crate::format::draft::{Direction, Draft, MAX_COUNT};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Name without its quotes, with its position.
#[derive(Default)]
pub struct Name {
    pub text: String,
    pub span: Span,
}

/// Declaration: a line about the net.
pub enum Declaration {
    Net(Name),
    Place {
        name: Name,
        tokens: u64,
    },
    /// Transition with its arcs in the order of the text, with weights.
    Transition {
        name: Name,
        arcs: Vec<(Direction, Name, u64)>,
    },
}

/// Converts a line; `None` if an error was reported, or the line is not about the net itself. What a safe net cannot
/// have is recorded in the draft.
pub fn declaration(line: Pair<'_, Rule>, draft: &mut Draft, diagnostics: &mut Vec<Diagnostic>) -> Option<Declaration> {
    match line.as_rule() {
        Rule::net => line.into_inner().find_map(name).map(Declaration::Net),
        Rule::place => Some(place(line, draft, diagnostics)),
        Rule::transition => Some(transition(line, draft, diagnostics)),
        Rule::priority => {
            let message = "priorities between transitions are not part of place/transition nets";
            refuse(span(&line), message, "model the priority by places, or leave the line out", diagnostics);
            None
        }
        Rule::bad_line => {
            diagnostics.push(expected::explain(line.as_str(), line.as_span().start()));
            None
        }
        // Labels and notes.
        _ => None,
    }
}

fn place(line: Pair<'_, Rule>, draft: &mut Draft, diagnostics: &mut Vec<Diagnostic>) -> Declaration {
    let mut place = Name::default();
    let mut tokens = 0;
    for piece in line.into_inner() {
        match piece.as_rule() {
            Rule::marking => {
                let span = span(&piece);
                let number = number(piece);
                tokens = count(number, span, diagnostics);
                if tokens > 1 {
                    let message = format!("the place `{}` has {number} tokens at the beginning", place.text);
                    draft.refuse(span, message, "a place of a safe net holds one token at most");
                }
            }
            _ => place = name(piece).unwrap_or(place),
        }
    }
    Declaration::Place { name: place, tokens }
}

fn transition(line: Pair<'_, Rule>, draft: &mut Draft, diagnostics: &mut Vec<Diagnostic>) -> Declaration {
    let mut transition = Name::default();
    let mut arcs = Vec::new();
    for piece in line.into_inner() {
        match piece.as_rule() {
            Rule::interval if !is_untimed(piece.as_str()) => {
                let message = format!("the interval `{}` makes this a time net", piece.as_str().trim_end());
                refuse(span(&piece), message, "leave the interval out: time is not modelled", diagnostics);
            }
            Rule::input | Rule::output => arcs.push(arc(piece, draft, diagnostics)),
            _ => transition = name(piece).unwrap_or(transition),
        }
    }
    Declaration::Transition { name: transition, arcs }
}

/// Converts an arc; rejects arcs that are neither weighted nor tests.
fn arc(pair: Pair<'_, Rule>, draft: &mut Draft, diagnostics: &mut Vec<Diagnostic>) -> (Direction, Name, u64) {
    let span = span(&pair);
    let mut direction = if pair.as_rule() == Rule::output { Direction::Produce } else { Direction::Consume };
    let mut place = Name::default();
    let mut weight = 1;
    for piece in pair.into_inner() {
        let rule = piece.as_rule();
        match rule {
            Rule::bare | Rule::braced => place = name(piece).unwrap_or(place),
            Rule::weight | Rule::test => {
                let number = number(piece);
                weight = count(number, span, diagnostics);
                if weight == 0 {
                    let help = "leave the arc out, or give it a weight from 1";
                    refuse(span, format!("this arc has weight {number}"), help, diagnostics);
                }
                if rule == Rule::test {
                    direction = Direction::Read;
                    if weight > 1 {
                        let help = "a place of a safe net holds one token at most: test with `?1`";
                        draft.refuse(span, format!("this arc tests for {number} tokens"), help);
                    }
                } else if weight > 1 {
                    let help = "in a safe net every arc has weight 1";
                    draft.refuse(span, format!("this arc has weight {number}"), help);
                }
            }
            Rule::inhibitor => {
                let message = "an inhibitor arc is not part of place/transition nets";
                refuse(span, message, "test the complementary place with `?1` instead", diagnostics);
            }
            _ => {
                let message = "a stopwatch arc makes this a time net";
                refuse(span, message, "time is not modelled", diagnostics);
            }
        }
    }
    (direction, place, weight)
}

fn refuse(span: Span, message: impl Into<String>, help: &str, diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.push(Diagnostic::new(Code::NetNotOrdinary, span, message).help(help));
}

/// Whether an interval is the trivial one, as written by TINA.
fn is_untimed(interval: &str) -> bool {
    interval.chars().filter(|c| !c.is_whitespace()).eq("[0,w[".chars())
}

/// The number in a pair, without leading zeros.
fn number(pair: Pair<'_, Rule>) -> &str {
    let number = pair.into_inner().find(|piece| piece.as_rule() == Rule::number);
    let digits = number.map_or("", |number| number.as_str()).trim_start_matches('0');
    // Of a zero, at most its suffix K or M remains.
    if digits.starts_with(|c: char| c.is_ascii_digit()) { digits } else { "0" }
}

/// Value of a number with a suffix: `K` is a thousand, and so on.
fn count(number: &str, span: Span, diagnostics: &mut Vec<Diagnostic>) -> u64 {
    let digits = number.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let factor = match &number[digits.len()..] {
        "" => 1,
        "K" => 1_000,
        "M" => 1_000_000,
        "G" => 1_000_000_000,
        "T" => 1_000_000_000_000,
        "P" => 1_000_000_000_000_000,
        _ => 1_000_000_000_000_000_000_u64,
    };
    let count = digits.parse::<u64>().ok().and_then(|count| count.checked_mul(factor)).filter(|&n| n <= MAX_COUNT);
    count.unwrap_or_else(|| {
        refuse(span, format!("{number} tokens are more than can be counted"), "write a smaller number", diagnostics);
        1
    })
}

/// Converts a name, if the pair is one.
fn name(pair: Pair<'_, Rule>) -> Option<Name> {
    let span = span(&pair);
    let text = match pair.as_rule() {
        Rule::bare => pair.as_str().to_owned(),
        Rule::braced => unescape(pair.into_inner().as_str()),
        _ => return None,
    };
    Some(Name { text, span })
}

fn unescape(quoted: &str) -> String {
    let mut chars = quoted.chars();
    std::iter::from_fn(|| chars.next().and_then(|c| if c == '\\' { chars.next() } else { Some(c) })).collect()
}

fn span(pair: &Pair<'_, Rule>) -> Span {
    let start = pair.as_span().start();
    Span::new(start, start + pair.as_str().trim_end().len())
}
