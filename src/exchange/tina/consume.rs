//! pest's pairs to declarations; what a safe net does not have is refused here.

use pest::iterators::Pair;

use super::expected;
use super::read::Rule;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// A name without its quoting, and where it stands.
#[derive(Default)]
pub struct Name {
    pub text: String,
    pub span: Span,
}

/// A line that says something about the net.
pub enum Declaration {
    Net(Name),
    Place {
        name: Name,
        marked: bool,
    },
    /// The arcs in the order of the text.
    Transition {
        name: Name,
        arcs: Vec<(Direction, Name)>,
    },
}

/// What an arc does to its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    Consume,
    Read,
    Produce,
}

/// A line; `None` if it is reported, or says nothing about the net itself.
pub fn declaration(line: Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) -> Option<Declaration> {
    match line.as_rule() {
        Rule::net => line.into_inner().find_map(name).map(Declaration::Net),
        Rule::place => Some(place(line, diagnostics)),
        Rule::transition => Some(transition(line, diagnostics)),
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

fn place(line: Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) -> Declaration {
    let mut place = Name::default();
    let mut marked = false;
    for piece in line.into_inner() {
        match piece.as_rule() {
            Rule::marking => {
                let span = span(&piece);
                match number(piece) {
                    "0" => {}
                    "1" => marked = true,
                    tokens => {
                        let message = format!("the place `{}` has {tokens} tokens at the beginning", place.text);
                        refuse(span, message, "a place of a safe net holds one token at most", diagnostics);
                    }
                }
            }
            _ => place = name(piece).unwrap_or(place),
        }
    }
    Declaration::Place { name: place, marked }
}

fn transition(line: Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) -> Declaration {
    let mut transition = Name::default();
    let mut arcs = Vec::new();
    for piece in line.into_inner() {
        match piece.as_rule() {
            Rule::interval if !is_untimed(piece.as_str()) => {
                let message = format!("the interval `{}` makes this a time net", piece.as_str().trim_end());
                refuse(span(&piece), message, "leave the interval out: time is not modelled", diagnostics);
            }
            Rule::input | Rule::output => arcs.push(arc(piece, diagnostics)),
            _ => transition = name(piece).unwrap_or(transition),
        }
    }
    Declaration::Transition { name: transition, arcs }
}

/// Refuses all arcs but those of weight 1 and tests for one token.
fn arc(pair: Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) -> (Direction, Name) {
    let span = span(&pair);
    let mut direction = if pair.as_rule() == Rule::output { Direction::Produce } else { Direction::Consume };
    let mut place = Name::default();
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::bare | Rule::braced => place = name(piece).unwrap_or(place),
            rule => {
                if rule == Rule::test {
                    direction = Direction::Read;
                }
                let (message, help) = match (rule, number(piece)) {
                    (Rule::weight | Rule::test, "1") => continue,
                    (Rule::weight, n) => (format!("this arc has weight {n}"), "in a safe net every arc has weight 1"),
                    (Rule::test, n) => {
                        let help = "a place of a safe net holds one token at most: test with `?1`";
                        (format!("this arc tests for {n} tokens"), help)
                    }
                    (Rule::inhibitor, _) => (
                        "an inhibitor arc is not part of place/transition nets".to_owned(),
                        "test the complementary place with `?1` instead",
                    ),
                    _ => ("a stopwatch arc makes this a time net".to_owned(), "time is not modelled"),
                };
                refuse(span, message, help, diagnostics);
            }
        }
    }
    (direction, place)
}

fn refuse(span: Span, message: impl Into<String>, help: &str, diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.push(Diagnostic::new(Code::NetNotOrdinary, span, message).help(help));
}

/// Without time, as TINA writes it.
fn is_untimed(interval: &str) -> bool {
    interval.chars().filter(|c| !c.is_whitespace()).eq("[0,w[".chars())
}

/// The number in a pair, without leading zeros.
fn number(pair: Pair<'_, Rule>) -> &str {
    let number = pair.into_inner().find(|piece| piece.as_rule() == Rule::number);
    let digits = number.map_or("", |number| number.as_str()).trim_start_matches('0');
    // Nothing is left of a zero but perhaps its K or M.
    if digits.starts_with(|c: char| c.is_ascii_digit()) { digits } else { "0" }
}

/// A name, if the pair is one.
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
