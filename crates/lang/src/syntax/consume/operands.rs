//! Literals, variables, and arguments of calls.

use pest::iterators::Pair;

use super::instructions::{operation, operator};
use super::{name, span};
use crate::syntax::ast::{
    Argument, Constant, Feed, Instruction, Literal, Name, Operand, Operation, Part, Path, Subscript,
};
use crate::syntax::parse::Rule;
use petril_base::source::Span;

/// Consumes a pair of the rule `constant`.
pub fn constant(pair: &Pair<'_, Rule>) -> Constant {
    let text = pair.as_str().trim().to_owned();
    Constant { literal: Literal::read(&text), text, span: span(pair) }
}

/// Consumes a pair of the rule `operand`.
pub fn operand(pair: Pair<'_, Rule>) -> Option<Operand> {
    let piece = pair.into_inner().next()?;
    Some(match piece.as_rule() {
        Rule::constant => Operand::Constant(constant(&piece)),
        _ => Operand::Variable(path(piece.into_inner().next()?)),
    })
}

/// Consumes a pair of the rule `symbolic_variable`, `direct_variable` or `subscript`.
pub fn path(pair: Pair<'_, Rule>) -> Path {
    let whole = name(&pair);
    let span = whole.span;
    let mut path = Path { root: whole, parts: Vec::new(), span };
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::identifier => path.root = name(&piece),
            Rule::member => path.parts.push(Part::Member(member(&piece))),
            Rule::index => {
                let span = super::span(&piece);
                path.parts.push(Part::Index(piece.into_inner().map(subscript).collect(), span));
            }
            Rule::constant => {
                let index = constant(&piece);
                path.parts.push(Part::Index(vec![Subscript::Constant(index)], super::span(&piece)));
            }
            _ => {}
        }
    }
    path
}

/// Name of a member, after the dot.
fn member(pair: &Pair<'_, Rule>) -> Name {
    let mut name = name(pair);
    name.text.remove(0);
    name.span.start += 1;
    name
}

fn subscript(pair: Pair<'_, Rule>) -> Subscript {
    match pair.clone().into_inner().next() {
        Some(piece) if piece.as_rule() == Rule::constant => Subscript::Constant(constant(&piece)),
        _ => Subscript::Variable(path(pair)),
    }
}

/// Consumes a pair of the rule `argument`.
pub fn argument(pair: Pair<'_, Rule>) -> Option<Argument> {
    let mut negated = false;
    let mut named: Option<(Name, bool)> = None;
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::negated_output => negated = true,
            Rule::named => {
                let mut pieces = piece.into_inner();
                let name = name(&pieces.next()?);
                named = Some((name, pieces.next()?.as_str() == "=>"));
            }
            Rule::argument_list => {
                let list = piece.into_inner().map(line);
                let (name, _) = named.filter(|(_, output)| !output)?;
                return Some(Argument::Input { name, value: Feed::List(list.collect()) });
            }
            _ => {
                let operand = operand(piece)?;
                return Some(match named {
                    None => Argument::Positional(operand),
                    Some((name, true)) => Argument::Output { negated, name, target: operand },
                    Some((name, false)) => Argument::Input { name, value: Feed::Operand(operand) },
                });
            }
        }
    }
    None
}

/// Instruction of a list in a call.
fn line(pair: Pair<'_, Rule>) -> Instruction {
    let span = span(&pair);
    if !matches!(pair.as_rule(), Rule::outer_parenthesis | Rule::inner_parenthesis) {
        return Instruction { label: None, operation: Some(operation(pair)), span };
    }
    let mut found = None;
    let mut first = None;
    let mut body = Vec::new();
    for piece in pair.into_inner() {
        match piece.as_rule() {
            Rule::expr_operator => found = Some(operator(piece.as_str())),
            Rule::operand => first = operand(piece),
            _ => body.push(line(piece)),
        }
    }
    let close = Span::new(span.end.saturating_sub(1), span.end);
    let parenthesis = found.map(|operator| Operation::Parenthesis { operator, first, body, close });
    Instruction { label: None, operation: parenthesis, span }
}
