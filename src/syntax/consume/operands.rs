//! Literals, variables, and what is handed over in calls.

use pest::iterators::Pair;

use super::instructions::operation;
use super::{name, span};
use crate::syntax::ast::{Argument, Constant, Feed, Instruction, Literal, Name, Operand, Part, Path, Subscript};
use crate::syntax::parse::Rule;

/// The pair of the rule `constant`.
pub fn constant(pair: &Pair<'_, Rule>) -> Constant {
    let text = pair.as_str().trim().to_owned();
    Constant { literal: Literal::read(&text), text, span: span(pair) }
}

/// The pair of the rule `operand`.
pub fn operand(pair: Pair<'_, Rule>) -> Option<Operand> {
    let piece = pair.into_inner().next()?;
    Some(match piece.as_rule() {
        Rule::constant => Operand::Constant(constant(&piece)),
        _ => Operand::Variable(path(piece.into_inner().next()?)),
    })
}

/// The pair of the rule `symbolic_variable`, `direct_variable` or `subscript`.
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

/// What stands behind the dot.
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

/// The pair of the rule `argument`.
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
                let list = piece.into_inner().map(|line| {
                    let span = span(&line);
                    Instruction { label: None, operation: Some(operation(line)), span }
                });
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
