//! pest's pairs to the syntax tree: units and declarations. The instruction list is in [`instructions`].

mod instructions;
mod other_language;

use pest::iterators::Pair;

use super::ast::{Constant, Declaration, Name, Pou, PouKind, Unit, VarBlock, VarKind};
use super::expected;
use super::parse::Rule;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// The pair of the rule `unit`.
pub fn unit(pair: Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) -> Unit {
    let mut unit = Unit::default();
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::pou => unit.pous.extend(pou(piece, diagnostics)),
            Rule::aside => {
                let word = first_word(&piece);
                let message = format!("`{}` is not part of what is checked", word.text);
                diagnostics.push(
                    Diagnostic::new(Code::PouNotChecked, word.span, message)
                        .help("only the program itself is modelled: it is executed once in every scan"),
                );
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
            Rule::result_type => result = Some(name(&piece)),
            _ => {
                let explained = expected::explain(Rule::lone_head, whole_head.as_str(), kind_word.span.start);
                let help = format!("it begins like `{kind} name`");
                diagnostics.push(if explained.help.is_empty() { explained.help(help) } else { explained });
            }
        }
    }
    let mut pou = Pou { kind, name: pou_name, result, blocks: Vec::new(), body: Vec::new() };
    let mut ended = false;
    for piece in pieces {
        match piece.as_rule() {
            Rule::var_block => pou.blocks.push(var_block(piece, diagnostics)),
            Rule::body => {
                let (body, late_blocks) = instructions::body(piece, diagnostics);
                pou.body = body;
                pou.blocks.extend(late_blocks);
            }
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
    let is_begun = !(pou.name.text.is_empty() && pou.blocks.is_empty() && pou.body.is_empty());
    if !ended && is_begun {
        let message = format!("this `{kind}` has no end");
        diagnostics.push(
            Diagnostic::new(Code::EndMissing, kind_word.span, message)
                .help(format!("put `END_{kind}` behind its last instruction")),
        );
    }
    Some(pou)
}

fn var_block(pair: Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) -> VarBlock {
    let mut block = VarBlock {
        kind: VarKind::Local,
        constant: false,
        retain: None,
        declarations: Vec::new(),
        span: Span::default(),
    };
    let mut ended = false;
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::var_kind => {
                let word = name(&piece);
                block.span = word.span;
                block.kind = match word.key().as_str() {
                    "VAR_INPUT" => VarKind::Input,
                    "VAR_OUTPUT" => VarKind::Output,
                    "VAR_IN_OUT" => VarKind::InOut,
                    "VAR_TEMP" => VarKind::Temp,
                    "VAR_EXTERNAL" => VarKind::External,
                    "VAR_GLOBAL" => VarKind::Global,
                    _ => VarKind::Local,
                };
            }
            Rule::var_qualifier => match name(&piece) {
                word if word.key() == "CONSTANT" => block.constant = true,
                word => block.retain = Some(word),
            },
            Rule::declaration => block.declarations.push(declaration(piece)),
            Rule::bad_declaration => block.declarations.push(bad_declaration(&piece, diagnostics)),
            Rule::var_end => ended = true,
            _ => {}
        }
    }
    if !ended {
        let message = format!("this `{}` block has no end", block.kind);
        diagnostics.push(
            Diagnostic::new(Code::EndMissing, block.span, message).help("put `END_VAR` behind its last declaration"),
        );
    }
    block
}

fn declaration(pair: Pair<'_, Rule>) -> Declaration {
    let mut declaration = Declaration { names: Vec::new(), location: None, type_text: None, initial: None };
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::declared => declaration.names.push(name(&piece)),
            Rule::location => declaration.location = piece.into_inner().next().map(|address| name(&address)),
            Rule::type_text => declaration.type_text = Some(name(&piece)),
            Rule::initial => declaration.initial = Some(constant(piece)),
            _ => {}
        }
    }
    declaration
}

/// Keeps the names of a declaration that cannot be read, so that their uses are not reported as well.
fn bad_declaration(pair: &Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) -> Declaration {
    let start = pair.as_span().start();
    let explained = expected::explain(Rule::lone_declaration, pair.as_str(), start);
    let help = "a declaration is like `a, b : BOOL := TRUE;`";
    diagnostics.push(if explained.help.is_empty() { explained.help(help) } else { explained });
    let listed = pair.as_str().split([':', ';']).next().unwrap_or_default();
    let words = listed.split([',', ' ', '\t']).scan(start, |at, word| {
        let span = Span::new(*at, *at + word.len());
        *at = span.end + 1;
        Some(Name { text: word.to_owned(), span })
    });
    let names = words.filter(|name| !name.text.is_empty()).collect();
    Declaration { names, location: None, type_text: None, initial: None }
}

fn constant(pair: Pair<'_, Rule>) -> Constant {
    let (text, span) = (pair.as_str().trim().to_owned(), span(&pair));
    let literal = pair.into_inner().next().filter(|p| p.as_rule() == Rule::constant);
    let literal = literal.and_then(|constant| constant.into_inner().next());
    let boolean = literal.filter(|p| p.as_rule() == Rule::boolean).map(|_| boolean(&text));
    Constant { text, boolean, span }
}

/// The value of a Boolean literal.
fn boolean(text: &str) -> bool {
    let value = text.rsplit('#').next().unwrap_or(text);
    value == "1" || value.eq_ignore_ascii_case("TRUE")
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
