//! Declarations of variables and data types.

use pest::iterators::Pair;

use super::operands::{constant, path};
use super::{first_word, name, span};
use crate::syntax::ast::{
    Declaration, Initial, InitialKind, Literal, Name, Range, TypeDeclaration, TypeSpec, VarBlock, VarKind,
};
use crate::syntax::expected;
use crate::syntax::parse::Rule;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Consumes a pair of the rule `var_block`.
pub fn var_block(pair: Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) -> VarBlock {
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
                    "VAR_ACCESS" | "VAR_CONFIG" => VarKind::Access,
                    _ => VarKind::Local,
                };
            }
            Rule::var_qualifier => match name(&piece) {
                word if word.is("CONSTANT") => block.constant = true,
                word => block.retain = Some(word),
            },
            Rule::declaration => block.declarations.push(declaration(piece)),
            // Blocks of this kind are refused as a whole.
            Rule::bad_declaration if block.kind == VarKind::Access => {}
            Rule::bad_declaration => {
                let names = bad_declaration(&piece, Rule::lone_declaration, diagnostics);
                block.declarations.push(Declaration { names, location: None, spec: None, edge: None, initial: None });
            }
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

/// Consumes a pair of the rule `type_block`.
pub fn type_block(pair: Pair<'_, Rule>, diagnostics: &mut Vec<Diagnostic>) -> Vec<TypeDeclaration> {
    let word = first_word(&pair);
    let mut types = Vec::new();
    let mut ended = false;
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::type_declaration => types.extend(type_declaration(piece)),
            Rule::bad_declaration => {
                let names = bad_declaration(&piece, Rule::lone_type, diagnostics).into_iter();
                types.extend(names.map(|name| TypeDeclaration { name, spec: None, initial: None }));
            }
            Rule::type_end => ended = true,
            _ => {}
        }
    }
    if !ended {
        let message = "this `TYPE` block has no end";
        diagnostics
            .push(Diagnostic::new(Code::EndMissing, word.span, message).help("put `END_TYPE` behind its last type"));
    }
    types
}

fn type_declaration(pair: Pair<'_, Rule>) -> Option<TypeDeclaration> {
    let mut pieces = pair.into_inner();
    let mut declaration = TypeDeclaration { name: name(&pieces.next()?), spec: None, initial: None };
    for piece in pieces {
        match piece.as_rule() {
            Rule::type_spec => declaration.spec = type_spec(piece),
            Rule::initial => declaration.initial = initial(piece),
            _ => {}
        }
    }
    Some(declaration)
}

fn declaration(pair: Pair<'_, Rule>) -> Declaration {
    let mut declaration = Declaration { names: Vec::new(), location: None, spec: None, edge: None, initial: None };
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::declared => declaration.names.push(name(&piece)),
            Rule::location => declaration.location = piece.into_inner().next().map(|address| name(&address)),
            Rule::type_spec => declaration.spec = type_spec(piece),
            Rule::edge => declaration.edge = Some(name(&piece)),
            Rule::initial => declaration.initial = initial(piece),
            _ => {}
        }
    }
    declaration
}

fn type_spec(pair: Pair<'_, Rule>) -> Option<TypeSpec> {
    let piece = pair.into_inner().next()?;
    let whole = span(&piece);
    Some(match piece.as_rule() {
        Rule::array => {
            let (ranges, of): (Vec<_>, Vec<_>) = piece.into_inner().partition(|p| p.as_rule() == Rule::range);
            let of = Box::new(type_spec(of.into_iter().find(|p| p.as_rule() == Rule::type_spec)?)?);
            TypeSpec::Array { ranges: ranges.into_iter().filter_map(range).collect(), of, span: whole }
        }
        Rule::structure => {
            let span = first_word(&piece).span;
            let members = piece.into_inner().filter(|p| p.as_rule() == Rule::declaration);
            TypeSpec::Structure { members: members.map(declaration).collect(), span }
        }
        Rule::enumeration => TypeSpec::Enumeration(piece.into_inner().map(|value| name(&value)).collect()),
        Rule::subrange => {
            let mut pieces = piece.into_inner();
            TypeSpec::Subrange { base: name(&pieces.next()?), range: range(pieces.next()?)? }
        }
        _ => TypeSpec::Named(name(&piece)),
    })
}

fn range(pair: Pair<'_, Rule>) -> Option<Range> {
    let mut bounds = pair.into_inner().map(|bound| name(&bound));
    Some(Range { lower: bounds.next()?, upper: bounds.next()? })
}

/// Consumes a pair of the rule `initial`.
pub fn initial(pair: Pair<'_, Rule>) -> Option<Initial> {
    let span = span(&pair);
    let piece = pair.into_inner().next()?;
    let kind = match piece.as_rule() {
        Rule::constant => InitialKind::Constant(constant(&piece)),
        Rule::initial_list => InitialKind::List(piece.into_inner().filter_map(item).collect()),
        Rule::initial_structure => InitialKind::Structure(piece.into_inner().filter_map(member).collect()),
        _ => InitialKind::Name(path(piece)),
    };
    Some(Initial { kind, span })
}

/// Value of a list, with its repetition count: `3`, `5(0)`, `5()`.
fn item(pair: Pair<'_, Rule>) -> Option<(u64, Initial)> {
    let mut pieces = pair.into_inner();
    let first = pieces.next()?;
    if first.as_rule() == Rule::initial {
        return Some((1, initial(first)?));
    }
    let times = match Literal::read(first.as_str())? {
        Literal::Integer(times) => u64::try_from(times).ok()?,
        _ => return None,
    };
    let default = InitialKind::List(Vec::new());
    let value = match pieces.next() {
        Some(value) => initial(value)?,
        None => Initial { kind: default, span: span(&first) },
    };
    Some((times, value))
}

fn member(pair: Pair<'_, Rule>) -> Option<(Name, Initial)> {
    let mut pieces = pair.into_inner();
    Some((name(&pieces.next()?), initial(pieces.next()?)?))
}

/// Reports a declaration that cannot be read, and keeps its names, so that their uses are not reported as well.
fn bad_declaration(pair: &Pair<'_, Rule>, rule: Rule, diagnostics: &mut Vec<Diagnostic>) -> Vec<Name> {
    let start = pair.as_span().start();
    let explained = expected::explain(rule, pair.as_str(), start);
    let help = match rule {
        Rule::lone_type => "a type is declared like `Level : INT (0..100);`",
        _ => "a declaration is like `a, b : BOOL := TRUE;`",
    };
    diagnostics.push(if explained.help.is_empty() { explained.help(help) } else { explained });
    let listed = pair.as_str().split([':', ';']).next().unwrap_or_default();
    let words = listed.split([',', ' ', '\t']).scan(start, |at, word| {
        let span = Span::new(*at, *at + word.len());
        *at = span.end + 1;
        Some(Name { text: word.to_owned(), span })
    });
    words.filter(|name| !name.text.is_empty()).collect()
}
