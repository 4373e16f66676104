//! Descriptions of faults in words.

use super::super::formula::Formula;
use super::changes::{Change, Fault};
use super::model::Model;
use super::nodes::formula;

/// Longest formula shown whole, in characters.
const LONG: usize = 72;

/// Longest neighbour shown whole, in characters.
const BESIDE: usize = 30;

/// A fault in words: "`!ACC_Tst` is negated in `F1`: `… & !ACC_Tst & …`".
#[must_use]
pub fn described(model: &Model<'_>, fault: &Fault) -> String {
    let at = &model.nodes[fault.node];
    let specification = model.specification;
    let text = |node: usize| short(&specification.text(&formula(&model.nodes, node)), LONG);
    let literal = |signal, is_plain: bool| {
        let name = specification.name(signal);
        if is_plain { format!("`{name}`") } else { format!("`!{name}`") }
    };
    let this = text(fault.node);
    let what = match fault.change {
        Change::Negated => format!("`{this}` is negated"),
        Change::Stuck(value) => format!("`{this}` is always {}", if value { "TRUE" } else { "FALSE" }),
        Change::Operator(other) => format!("`{this}` has `{}` for its operator", other.symbol()),
        Change::Converse => format!("`{this}` is `->` from right to left"),
        Change::Without(position) => {
            let operand = match &at.what {
                super::What::Gate(_, operands) => text(operands[position]),
                _ => String::new(),
            };
            format!("`{operand}` is missing in `{this}`")
        }
        Change::With(signal, is_plain) => format!("{} is a further operand of `{this}`", literal(signal, is_plain)),
        Change::Literal(signal, is_plain) => format!("{} stands for `{this}`", literal(signal, is_plain)),
    };
    match fault.change {
        Change::Negated | Change::Stuck(_) | Change::Literal(..) => format!("{what}{}", place(model, fault.node)),
        _ => format!("{what}{}", equation(model, fault.node)),
    }
}

/// A condition with its place: "`!ACC_Tst` in `… & !ACC_Tst & …`".
#[must_use]
pub fn named(model: &Model<'_>, node: usize) -> String {
    let this = model.specification.text(&formula(&model.nodes, node));
    format!("`{}`{}", short(&this, LONG), place(model, node))
}

/// Place of a node: its parent, cut down to the neighbouring operands.
fn place(model: &Model<'_>, node: usize) -> String {
    let at = &model.nodes[node];
    let specification = model.specification;
    let several = equation(model, node);
    let Some(parent) = at.parent else { return several };
    let Formula::Gate(operator, operands) = plain(formula(&model.nodes, parent)) else { return several };
    let position = match &model.nodes[parent].what {
        super::What::Gate(_, nodes) => nodes.iter().position(|other| *other == node).unwrap_or_default(),
        _ => 0,
    };
    let whole = specification.text(&Formula::Gate(operator, operands.clone()));
    if whole.chars().count() <= LONG {
        return format!(" in `{whole}`{several}");
    }
    let near = position.saturating_sub(1)..operands.len().min(position + 2);
    let mut pieces: Vec<String> = near.clone().map(|at| short(&specification.text(&operands[at]), BESIDE)).collect();
    if near.start > 0 {
        pieces.insert(0, "…".to_owned());
    }
    if near.end < operands.len() {
        pieces.push("…".to_owned());
    }
    format!(" in `{}`{several}", pieces.join(&format!(" {} ", operator.symbol())))
}

/// Name of a node's equation, if the model has several.
fn equation(model: &Model<'_>, node: usize) -> String {
    let equation = &model.equations[model.nodes[node].equation];
    if model.equations.len() > 1 {
        format!(" of `{}`", model.specification.name(equation.signal))
    } else {
        String::new()
    }
}

fn plain(formula: Formula) -> Formula {
    match formula {
        Formula::Not(inner) => *inner,
        other => other,
    }
}

/// Shortens a long text to its first and last words.
fn short(text: &str, long: usize) -> String {
    let length = |text: &str| text.chars().count();
    if length(text) <= long {
        return text.to_owned();
    }
    let words: Vec<&str> = text.split(' ').collect();
    let fits = |words: &mut dyn Iterator<Item = &&str>| {
        let mut used = 0;
        words.take_while(|word| (used += length(word) + 1, used <= long / 2).1).count()
    };
    let (first, last) = (fits(&mut words.iter()), fits(&mut words.iter().rev()));
    let (first, last) = (&words[..first], &words[words.len() - last..]);
    [first, &["…"], last].concat().join(" ")
}
