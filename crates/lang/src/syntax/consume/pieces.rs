//! Instruction lists and initial values taken out of a project in XML.

use std::collections::BTreeMap;

use pest::iterators::Pair;

use super::{declarations, first_word, instructions, other_language};
use crate::syntax::ast::{Initial, Instruction, VarBlock};
use crate::syntax::expected;
use crate::syntax::parse::Rule;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Syntax tree of one piece, with its diagnostics.
#[derive(Default)]
pub struct Piece {
    /// Instructions of a list.
    pub body: Vec<Instruction>,
    /// Declaration blocks that stand between the instructions, which has been reported.
    pub blocks: Vec<VarBlock>,
    /// Language of a body that is clearly not Instruction List, and the line that shows it.
    pub foreign: Option<(String, Span)>,
    /// Value of a piece that is an initial value.
    pub initial: Option<Initial>,
    pub diagnostics: Vec<Diagnostic>,
}

/// Consumes a pair of the rule `pieces`: each piece by its offset.
pub fn pieces(pair: Pair<'_, Rule>) -> BTreeMap<usize, Piece> {
    let mut pieces = BTreeMap::new();
    let mut start = 0;
    for part in pair.into_inner() {
        match part.as_rule() {
            Rule::body_mark | Rule::value_mark => start = part.as_span().end(),
            Rule::list_piece => _ = pieces.insert(start, list(part)),
            Rule::value_piece => _ = pieces.insert(start, value(part)),
            _ => {}
        }
    }
    pieces
}

fn list(pair: Pair<'_, Rule>) -> Piece {
    let mut piece = Piece::default();
    for part in pair.into_inner() {
        if part.as_rule() == Rule::left_over {
            let word = first_word(&part);
            let message = format!("`{}` cannot stand among instructions", word.text);
            let help = "the body of a unit holds its instructions only; what it declares stands in its interface";
            piece.diagnostics.push(Diagnostic::new(Code::Syntax, word.span, message).help(help));
            continue;
        }
        piece.foreign = other_language::recognize(part.clone());
        if piece.foreign.is_none() {
            (piece.body, piece.blocks) = instructions::body(part, &mut piece.diagnostics);
        }
    }
    piece
}

fn value(pair: Pair<'_, Rule>) -> Piece {
    let mut piece = Piece::default();
    for part in pair.into_inner() {
        if part.as_rule() == Rule::left_over {
            let text = part.as_str();
            let start = part.as_span().start() + text.len() - text.trim_start().len();
            let explained = expected::explain(Rule::lone_initial, text.trim(), start);
            let help = "an initial value is a literal like `5` or `TRUE`, the name of a constant, or a list of such";
            piece.diagnostics.push(if explained.help.is_empty() { explained.help(help) } else { explained });
        } else {
            piece.initial = declarations::initial(part);
        }
    }
    piece
}
