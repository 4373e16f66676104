//! Static semantics, from syntax tree to checked program: names resolved, values typed, every static rule applied.
//!
//! Declarations become shapes (`declare`), names symbols (`project`), instructions typed statements (`typing`); each
//! reports what it cannot read. The rules beyond that are the files `rule_….rs`, one sentence each.

mod address;
mod call_graph;
mod constant;
mod control_flow;
mod declare;
mod effect;
mod extent;
mod flow;
mod function;
mod inference;
mod initial;
mod interval;
mod library;
mod needed;
mod overlap;
mod program;
mod project;
mod shape;
mod strict;
mod symbols;
mod typing;
mod uses;
mod variables;

mod rule_constants_have_values;
mod rule_constants_not_written;
mod rule_control_outside_parentheses;
mod rule_inputs_not_written;
mod rule_instructions_reachable;
mod rule_jumps_forward;
mod rule_labels_defined;
mod rule_labels_unique;
mod rule_labels_used;
mod rule_parentheses_begin_with_value;
mod rule_result_defined;
mod rule_results_used;
mod rule_variables_used;

#[cfg(test)]
mod testing;

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};

pub use address::{Area, spelling};
pub use function::Function;
pub use library::{CLOCK, RUNNING, text as library_text};
pub use petril_base::{Kind, Type, VarId};
pub use program::{
    Action, Call, Callee, Condition, Enable, Feed, FeedSource, Index, Operand, Place, Pou, PouKind, Program, Role,
    Root, Standard, StandardFunction, Statement, Step, TypeId, Variable,
};
pub use shape::{Enumeration, Member, PouId, Scalar, Shape, Structure, Value, elements};
pub use strict::strict;
pub use symbols::Section;

use crate::syntax::ast::{self, Name, Unit};
use flow::Flow;
use petril_base::diagnostic::{Code, Diagnostic, any_error};
use petril_base::source::Span;
use project::Project;
use symbols::Symbols;

/// Input of a static rule: a unit, its names, and the file around it.
struct Context<'a> {
    project: &'a Project<'a>,
    id: PouId,
    pou: &'a ast::Pou,
    symbols: &'a Symbols,
    labels: BTreeMap<String, usize>,
    flow: OnceCell<Flow>,
}

impl Context<'_> {
    /// Flow of the unit's instruction list.
    fn flow(&self) -> &Flow {
        self.flow.get_or_init(|| Flow::of(self))
    }
}

/// Static rule: reports everything that breaks it.
type Rule = fn(&Context<'_>) -> Vec<Diagnostic>;

/// Static rules. Each is independent of the others, and runs whatever they found.
const RULES: &[Rule] = &[
    rule_constants_have_values::apply,
    rule_constants_not_written::apply,
    rule_control_outside_parentheses::apply,
    rule_inputs_not_written::apply,
    rule_instructions_reachable::apply,
    rule_labels_defined::apply,
    rule_labels_unique::apply,
    rule_labels_used::apply,
    rule_parentheses_begin_with_value::apply,
    rule_result_defined::apply,
];

/// Rules about what is allowed and probably not meant. Only programs without errors are checked: what a broken line
/// would have used is not known.
const DOUBTS: &[Rule] = &[rule_jumps_forward::apply, rule_results_used::apply, rule_variables_used::apply];

/// Checks the program of a file with all it calls. The program is `None` exactly if one of the diagnostics, or one
/// found while reading the text, is an error; `clean` says that reading found none.
#[must_use]
pub fn check(unit: &Unit, clean: bool) -> (Option<Program>, Vec<Diagnostic>) {
    check_unit(unit, clean, None)
}

/// Checks as [`check`] does, but the program, function block or function of this name, where one is given. Everything
/// it does not need is ignored.
#[must_use]
pub fn check_unit(unit: &Unit, clean: bool, name: Option<&str>) -> (Option<Program>, Vec<Diagnostic>) {
    let needed;
    let unit = match name {
        Some(name) if unit.pous.iter().all(|pou| !pou.name.is(name)) => return (None, vec![no_unit(unit, name)]),
        Some(name) => {
            needed = needed::by(unit, name);
            &needed
        }
        None => unit,
    };
    let (project, mut diagnostics, mut of_units) = Project::of(unit);
    let entry = match name {
        Some(name) => project.find(name),
        None => entry(&project, &mut diagnostics),
    };
    let Some(entry) = entry else { return (None, diagnostics) };
    let needed = project.reachable(entry, &mut diagnostics);
    extent::check(&project, &needed, &mut diagnostics);
    overlap::check(&project, &needed, &mut diagnostics);
    diagnostics.extend(without_caller(&project, entry));
    let mut pous = BTreeMap::new();
    let mut own = Vec::new();
    for &id in &needed {
        let pou = project.pou(id);
        if let Some((language, span)) = &pou.foreign {
            diagnostics.push(foreign(pou, language, *span));
            continue;
        }
        let context = project.context(id);
        let typed = typing::unit(&context);
        if !project.is_library(id) {
            diagnostics.append(&mut of_units[id.0]);
            diagnostics.extend(typed.diagnostics);
            diagnostics.extend(RULES.iter().flat_map(|rule| rule(&context)));
            own.push(context);
        }
        let checked = Pou {
            name: pou.name.text.clone(),
            kind: pou.kind,
            is_library: project.is_library(id),
            variables: variables(project.symbols(id)),
            body: typed.body,
            types: typed.types,
            literals: typed.literals,
        };
        pous.insert(id, checked);
    }
    let interval = interval::of(unit, &project.pou(entry).name, &mut diagnostics);
    if clean && !any_error(&diagnostics) {
        diagnostics.extend(not_checked(&project, &needed));
        diagnostics.extend(own.iter().flat_map(|context| DOUBTS.iter().flat_map(move |rule| rule(context))));
    }
    diagnostics.sort_by_key(Diagnostic::span);
    diagnostics.dedup();
    if !clean || any_error(&diagnostics) {
        return (None, diagnostics);
    }
    let globals = variables(&project.globals);
    (Some(Program { pous, entry, globals, interval }), diagnostics)
}

/// Error that no unit of the file has the requested name.
fn no_unit(unit: &Unit, name: &str) -> Diagnostic {
    let first = unit.pous.first().map_or(Span::default(), |pou| pou.name.span);
    let names = unit.pous.iter().map(|pou| pou.name.text.as_str());
    let message = format!("there is no program, function block or function `{name}` in this file");
    Diagnostic::new(Code::NameNotDeclared, first, message).here("the first one is here").suggest(name, names)
}

/// Unit to check: the PROGRAM of the file; where there is none, the last function block or function that no other
/// calls.
fn entry(project: &Project<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<PouId> {
    let own = || project.unit.pous.iter().enumerate().map(|(i, pou)| (PouId(i), pou));
    let mut programs = own().filter(|(_, pou)| pou.kind == PouKind::Program);
    if let Some((id, program)) = programs.next() {
        diagnostics.extend(programs.map(|(_, second)| {
            Diagnostic::new(Code::SeveralPrograms, second.name.span, "this file declares a second program")
                .also(program.name.span, "the first is here")
                .help("name the one to check by `--pou`, or put each program in a file of its own")
        }));
        return Some(id);
    }
    let calls = own().flat_map(|(id, _)| project.calls(id).into_iter().filter(move |(callee, _)| *callee != id));
    let called: BTreeSet<PouId> = calls.map(|(callee, _)| callee).collect();
    let (id, pou) = own().rfind(|(id, _)| !called.contains(id)).or_else(|| own().next_back())?;
    let message = format!("this file holds no program, so {} `{}` is checked by itself", pou.kind, pou.name.text);
    diagnostics.push(
        Diagnostic::new(Code::CheckedByItself, pou.name.span, message)
            .help("it is executed once in every scan, and its inputs may have any values"),
    );
    Some(id)
}

fn foreign(pou: &ast::Pou, language: &str, span: Span) -> Diagnostic {
    if language.is_empty() {
        let message = format!("`{}` has no body", pou.name.text);
        return Diagnostic::new(Code::OtherLanguage, span, message)
            .help("what it does is not in this file: put its instruction list there");
    }
    let how = if language.ends_with("Chart") || language.ends_with("Diagram") { "as" } else { "in" };
    let message = format!("`{}` is written {how} {language}, not in Instruction List", pou.name.text);
    let help = match language {
        "Structured Text" => "only Instruction List is read: instead of `q := a AND b;` write `LD a`, `AND b`, `ST q`",
        _ => "only Instruction List is read",
    };
    Diagnostic::new(Code::OtherLanguage, span, message)
        .help(help)
        .help("many engineering tools convert a unit to IL; a unit that does not need this one is checked alone by `--pou NAME`")
}

/// Reports in-out variables of the unit that nothing calls.
fn without_caller<'a>(project: &'a Project<'_>, entry: PouId) -> impl Iterator<Item = Diagnostic> + 'a {
    let in_outs = project.symbols(entry).list().iter().filter(|symbol| symbol.section == Section::InOut);
    in_outs.map(move |symbol| {
        let pou = project.pou(entry);
        let message =
            format!("`{}` stands for a variable of the caller, but nothing calls `{}`", symbol.name, pou.name.text);
        let help = match pou.kind {
            PouKind::Program => "declare it in `VAR_INPUT`, `VAR_OUTPUT` or `VAR_EXTERNAL`",
            _ => "write a `PROGRAM` that calls it with a variable",
        };
        Diagnostic::new(Code::InOutWithoutCaller, symbol.span, message).help(help)
    })
}

/// Reports units of the file that are not needed.
fn not_checked<'a>(project: &'a Project<'_>, needed: &'a [PouId]) -> impl Iterator<Item = Diagnostic> + 'a {
    let needed: BTreeSet<PouId> = needed.iter().copied().collect();
    let others = project.unit.pous.iter().enumerate().filter(move |(i, pou)| {
        let counts = project.find(&pou.name.text) == Some(PouId(*i)) && pou.kind != PouKind::Program;
        counts && !needed.contains(&PouId(*i)) && !pou.name.text.is_empty()
    });
    others.map(|(_, pou)| {
        let message = format!("{} `{}` is not called by the program and is not checked", pou.kind, pou.name.text);
        Diagnostic::new(Code::PouNotChecked, pou.name.span, message).help("call it, or check it in a file of its own")
    })
}

fn variables(symbols: &Symbols) -> Vec<Variable> {
    let variables = symbols.list().iter().map(|symbol| Variable {
        name: symbol.name.clone(),
        section: symbol.section,
        // A broken declaration has been reported, and the program is refused.
        shape: symbol.shape.clone().unwrap_or(Shape::Scalar(Scalar::new(Type::BOOL))),
        initial: symbol.initial.clone(),
        area: symbol.area(),
        address: symbol.location.as_ref().map(|location| spelling(&location.text)),
        span: symbol.span,
    });
    variables.collect()
}

/// Position of the instruction with a label.
fn target(labels: &BTreeMap<String, usize>, name: &Name) -> Option<usize> {
    labels.get(&name.key()).copied()
}
