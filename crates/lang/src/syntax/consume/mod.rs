//! Conversion of pest's pairs to the syntax tree: files and their program organisation units.

mod configuration;
mod declarations;
mod instructions;
mod operands;
mod other_language;
mod pieces;

use pest::iterators::Pair;
pub use pieces::{Piece, pieces};

use super::ast::{Name, Pou, PouKind, Unit, VarKind};
use super::expected;
use super::parse::Rule;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Consumes a pair of the rule `unit`.
pub fn unit(pair: Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) -> Unit {
    let mut unit = Unit::default();
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::pou => unit.pous.extend(pou(piece, diagnostics)),
            Rule::configuration => configuration::configuration(piece, &mut unit, diagnostics),
            Rule::type_block => unit.types.extend(declarations::type_block(piece, diagnostics)),
            Rule::var_block => {
                let block = declarations::var_block(piece, diagnostics);
                if block.kind != VarKind::Global {
                    let message = format!("a `{}` block stands outside of every program", block.kind);
                    let help = "move it behind the name of its program; only `VAR_GLOBAL` may stand alone";
                    diagnostics.push(Diagnostic::new(Code::Syntax, block.span, message).help(help));
                }
                unit.globals.push(block);
            }
            Rule::stray => {
                let word = first_word(&piece);
                let message = format!("expected `PROGRAM`, `FUNCTION` or `FUNCTION_BLOCK`, found `{}`", word.text);
                diagnostics.push(
                    Diagnostic::new(Code::Syntax, word.span, message)
                        .suggest(&word.text, ["PROGRAM", "FUNCTION", "FUNCTION_BLOCK"])
                        .help("an instruction list stands between `PROGRAM name` and `END_PROGRAM`"),
                );
            }
            _ => {}
        }
    }
    unit
}

fn pou(pair: Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) -> Option<Pou> {
    let mut pieces = pair.into_inner();
    let head = pieces.next()?;
    let whole_head = head.clone();
    let mut head_pieces = head.into_inner();
    let kind_word = name(&head_pieces.next()?);
    let kind = match kind_word.key().as_str() {
        "PROGRAM" => PouKind::Program,
        "FUNCTION" => PouKind::Function,
        _ => PouKind::FunctionBlock,
    };
    let mut pou_name = Name { text: String::new(), span: kind_word.span };
    let mut result = None;
    for piece in head_pieces {
        match piece.as_rule() {
            Rule::identifier => pou_name = name(&piece),
            Rule::type_name => result = Some(name(&piece)),
            _ => {
                let explained = expected::explain(Rule::lone_head, whole_head.as_str(), kind_word.span.start);
                let help = format!("it begins like `{kind} name`");
                diagnostics.push(if explained.help.is_empty() { explained.help(help) } else { explained });
            }
        }
    }
    let mut pou = Pou { kind, name: pou_name, result, blocks: Vec::new(), body: Vec::new(), foreign: None };
    let mut ended = false;
    for piece in pieces {
        match piece.as_rule() {
            Rule::var_block => pou.blocks.push(declarations::var_block(piece, diagnostics)),
            Rule::body => match other_language::recognize(piece.clone()) {
                Some(foreign) => pou.foreign = Some(foreign),
                None => {
                    let (body, late_blocks) = instructions::body(piece, diagnostics);
                    pou.body = body;
                    pou.blocks.extend(late_blocks);
                }
            },
            Rule::pou_end => {
                ended = true;
                let end = name(&piece);
                let word = end.text.trim_end_matches([';', ' ', '\t']).to_ascii_uppercase();
                if word != format!("END_{kind}") {
                    let message = format!("`{kind}` ends with `{word}`");
                    diagnostics.push(
                        Diagnostic::new(Code::EndMissing, end.span, message)
                            .also(kind_word.span, "begins here")
                            .help(format!("end it with `END_{kind}`")),
                    );
                }
            }
            _ => {}
        }
    }
    let is_begun = !(pou.name.text.is_empty() && pou.blocks.is_empty() && pou.body.is_empty() && pou.foreign.is_none());
    if !ended && is_begun {
        let message = format!("this `{kind}` has no end");
        diagnostics.push(
            Diagnostic::new(Code::EndMissing, kind_word.span, message)
                .help(format!("put `END_{kind}` behind its last instruction")),
        );
    }
    Some(pou)
}

fn span(pair: &Pair<'_, Rule>) -> Span {
    let text = pair.as_str();
    let start = pair.as_span().start();
    Span::new(start, start + text.trim_end().len())
}

fn name(pair: &Pair<'_, Rule>) -> Name {
    Name { text: pair.as_str().trim().to_owned(), span: span(pair) }
}

fn first_word(pair: &Pair<'_, Rule>) -> Name {
    let text = pair.as_str();
    let start = text.len() - text.trim_start().len();
    let word = text[start..].split_whitespace().next().unwrap_or_default();
    let start = pair.as_span().start() + start;
    Name { text: word.to_owned(), span: Span::new(start, start + word.len()) }
}
