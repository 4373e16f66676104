//! Typing of a unit, from its syntax tree to typed statements: every name resolved, every type settled.

mod calls;
mod operators;
mod places;
mod standard;
#[cfg(test)]
mod tests;

pub use standard::is_standard;

use std::collections::BTreeMap;

use petgraph::graph::NodeIndex;
use petgraph::visit::EdgeRef;

use super::Context;
use super::effect::{Leaves, effect};
use super::flow::Flow;
use super::inference::{Inference, Known, NOWHERE};
use super::program::{Action, Condition, Feed, FeedSource, Operand, Statement, TypeId};
use crate::syntax::ast::{self, Instruction, Literal, Name, Operation};
use petril_base::Type;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Typed instruction list.
pub struct Typed {
    pub body: Vec<Statement>,
    pub types: Vec<Type>,
    pub literals: Vec<u64>,
    pub diagnostics: Vec<Diagnostic>,
}

/// Types a unit. If there are diagnostics, the statements are incomplete.
pub fn unit(context: &Context<'_>) -> Typed {
    let mut typing = Typing {
        context,
        types: Inference::default(),
        diagnostics: Vec::new(),
        unknown: BTreeMap::new(),
        positions: Vec::new(),
        unknown_words: 0,
    };
    let body = typing.list();
    let (types, literals, more) = typing.types.settle();
    let mut diagnostics = typing.diagnostics;
    diagnostics.extend(more);
    diagnostics.extend(undeclared(typing.unknown, context));
    Typed { body, types, literals, diagnostics }
}

struct Typing<'a> {
    context: &'a Context<'a>,
    types: Inference,
    diagnostics: Vec<Diagnostic>,
    /// Undeclared names: the first use, and the number of uses.
    unknown: BTreeMap<String, (Name, usize)>,
    /// Positions of statements: instruction i of the text is statement `positions[i]`, since labels that stand alone
    /// are dropped.
    positions: Vec<usize>,
    /// Number of instructions that begin with an unknown word.
    unknown_words: usize,
}

impl Typing<'_> {
    /// Types the unit's instruction list.
    fn list(&mut self) -> Vec<Statement> {
        let body: &[Instruction] = &self.context.pou.body;
        let Flow { graph, effects, reachable, needed } = self.context.flow();
        let mut kept = 0;
        for instruction in body {
            self.positions.push(kept);
            kept += usize::from(instruction.operation.is_some());
        }
        self.positions.push(kept);
        let before: Vec<TypeId> = (0..=body.len()).map(|_| self.types.fresh()).collect();
        let mut after = Vec::with_capacity(body.len());
        let mut statements = Vec::with_capacity(kept);
        for (i, instruction) in body.iter().enumerate() {
            // The type from the line above is unified first, so that this line is the one reported.
            if i > 0 && needed[i] && graph.contains_edge(NodeIndex::new(i - 1), NodeIndex::new(i)) && reachable[i - 1] {
                let _ = self.types.unify(after[i - 1], before[i]);
            }
            let (action, result) = self.instruction(instruction, before[i]);
            statements.extend(action.map(|action| Statement { action, span: instruction.span }));
            after.push(match effects[i].1 {
                Leaves::Same => before[i],
                Leaves::Value => result,
                Leaves::Nothing => self.types.fresh(),
            });
        }
        for edge in graph.edge_references() {
            let (from, to) = (edge.source().index(), edge.target().index());
            if needed[to] && reachable[from] && to < body.len() && to != from + 1 {
                self.join(after[from], before[to], &body[from], &body[to]);
            }
        }
        statements
    }

    /// Unifies the types of the current result where control comes from another line; reports a difference.
    fn join(&mut self, from: TypeId, to: TypeId, source: &Instruction, target: &Instruction) {
        if let Err(known) = self.types.unify(to, from) {
            let (there, here) = *known;
            let message = format!(
                "the current result is `{}` here, but `{}` when control comes from another line",
                there.scalar, here.scalar
            );
            self.diagnostics.push(
                Diagnostic::new(Code::ResultTypesDiffer, target.span, message)
                    .also(source.span, format!("comes from here with `{}`", here.scalar))
                    .help("load the value behind the label, or use one type on all ways"),
            );
        }
    }

    /// Types an instruction: `result` is the type of the current result before it; returns the one after it, too.
    fn instruction(&mut self, instruction: &Instruction, result: TypeId) -> (Option<Action>, TypeId) {
        match &instruction.operation {
            None | Some(Operation::Broken) => (None, self.types.fresh()),
            Some(Operation::Simple { operator, operands }) => {
                self.simple(*operator, operands, instruction.span, result)
            }
            Some(Operation::Parenthesis { operator, first, body, close }) => {
                self.parenthesis(*operator, first.as_ref(), body, *close, instruction.span, result)
            }
            Some(Operation::Jump { condition, target }) => {
                self.condition(*condition, result, instruction.span);
                let at = crate::semantics::target(&self.context.labels, target);
                (at.map(|at| Action::Jump(*condition, self.positions[at])), result)
            }
            Some(Operation::Return { condition }) => {
                self.condition(*condition, result, instruction.span);
                (Some(Action::Return(*condition)), result)
            }
            Some(Operation::Call { condition, callee, arguments }) => {
                self.condition(*condition, result, instruction.span);
                (self.call(*condition, callee, arguments, instruction.span), result)
            }
            Some(Operation::Function { name, arguments }) => self.function(name, arguments, instruction.span, result),
        }
    }

    /// Requires that a condition be `BOOL`.
    fn condition(&mut self, condition: Condition, result: TypeId, span: Span) {
        if condition != Condition::Always {
            let boolean = self.types.boolean(NOWHERE);
            self.same(result, boolean, span, |known| {
                format!("a condition needs a `BOOL`, but the current result is `{}`", known.scalar)
            });
        }
    }

    /// Types a sequence without jumps, like the inside of a parenthesis.
    fn sequence(&mut self, body: &[Instruction], result: TypeId) -> (Vec<Statement>, TypeId) {
        let mut result = result;
        let mut statements = Vec::new();
        for instruction in body {
            let (action, next) = self.instruction(instruction, result);
            statements.extend(action.map(|action| Statement { action, span: instruction.span }));
            if effect(instruction, self.context).1 == Leaves::Value {
                result = next;
            }
        }
        (statements, result)
    }

    /// Unifies the type of the current result with another; reports a difference.
    fn same(&mut self, result: TypeId, other: TypeId, span: Span, message: impl Fn(&Known) -> String) {
        if let Err(known) = self.types.unify(result, other) {
            let (left, right) = *known;
            let mut diagnostic = Diagnostic::new(Code::TypesDiffer, span, message(&left));
            for known in [&right, &left].into_iter().filter(|known| !known.is_nowhere()) {
                let text = format!("of type `{}`", known.scalar);
                diagnostic = if known.span == span { diagnostic.here(text) } else { diagnostic.also(known.span, text) };
            }
            let help = conversion(&left, &right);
            self.diagnostics.push(match help {
                Some(help) => diagnostic.help(help),
                None => diagnostic,
            });
        }
    }

    /// Types an operand that is read. `None` has been reported.
    fn operand(&mut self, operand: &ast::Operand) -> Option<(TypeId, Operand)> {
        match operand {
            ast::Operand::Constant(constant) => {
                let project = self.context.project;
                if let Some(Literal::Enumerated(prefix, _)) = &constant.literal
                    && project.enumeration(prefix).is_none()
                {
                    let message = format!("there is no enumeration `{prefix}`");
                    let names = project.enumeration_names();
                    self.diagnostics.push(
                        Diagnostic::new(Code::TypeNotDeclared, constant.span, message)
                            .suggest(prefix, names)
                            .help(format!("declare it, like `TYPE {prefix} : (first, second); END_TYPE`")),
                    );
                    return None;
                }
                let (ty, position) = self.types.literal(constant, |name| project.enumeration(name));
                Some((ty, Operand::Literal(position)))
            }
            ast::Operand::Variable(path) => self.readable(path),
        }
    }

    /// Types an operand that is passed to an input.
    fn feed(&mut self, operand: &ast::Operand) -> Option<Feed> {
        let span = operand.span();
        let (ty, operand) = self.operand(operand)?;
        Some(Feed { ty, source: FeedSource::Operand(operand), span })
    }
}

/// Help on how to convert one type to the other, if a function does that.
fn conversion(left: &Known, right: &Known) -> Option<String> {
    let plain = left.scalar.enumeration.is_none() && right.scalar.enumeration.is_none();
    let (from, to) = (right.scalar.ty, left.scalar.ty);
    plain.then(|| match from.is_bool() != to.is_bool() {
        true => "a comparison, like `NE`, makes a `BOOL` of other values".to_owned(),
        false => format!("convert one of them, like with `{from}_TO_{to}`"),
    })
}

/// Reports undeclared names, each at its first use.
fn undeclared(unknown: BTreeMap<String, (Name, usize)>, context: &Context<'_>) -> Vec<Diagnostic> {
    let mut firsts: Vec<(Name, usize)> = unknown.into_values().collect();
    firsts.sort_by_key(|(name, _)| name.span);
    let found = firsts.into_iter().enumerate().map(|(i, (name, uses))| {
        let message = format!("`{}` is not declared", name.text);
        let diagnostic = Diagnostic::new(Code::NameNotDeclared, name.span, message);
        let names = context.symbols.names().chain(context.project.globals.names());
        let diagnostic = diagnostic.suggest_at(i, &name.text, names.chain(context.project.enumerator_names()));
        if uses > 1 { diagnostic.here(format!("the first of {uses} uses")) } else { diagnostic }
    });
    found.collect()
}
