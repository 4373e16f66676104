//! From syntax tree to checked program: names resolved, values typed, every static rule applied.
//!
//! Declarations become shapes ([`declare`]), names symbols ([`project`]), instructions typed statements ([`typing`]); what
//! these cannot read they report. The rules beyond that are the files `rule_….rs`, one sentence each.

mod constant;
mod control_flow;
mod declare;
mod effect;
mod expansion;
mod function;
mod inference;
mod initial;
mod interval;
mod library;
mod program;
mod project;
mod shape;
mod symbols;
mod types;
mod typing;
mod uses;

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
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};

pub use function::Function;
pub use library::{CLOCK, RUNNING, text as library_text};
pub use program::{
    Action, Call, Callee, Condition, Enable, Feed, FeedSource, Index, Operand, Place, Pou, PouKind, Program, Role,
    Root, Standard, StandardFunction, Statement, Step, TypeId, VarId, Variable,
};
pub use shape::{Enumeration, Member, PouId, Scalar, Shape, Structure, Value, elements};
pub use symbols::{Area, Section};
pub use types::{Kind, Type};

use crate::diagnostic::{Code, Diagnostic, any_error};
use crate::source::Span;
use crate::syntax::ast::{self, Name, Unit};
use project::Project;
use symbols::Symbols;

/// What a rule looks at: a unit, its names, and the file around it.
struct Context<'a> {
    project: &'a Project<'a>,
    id: PouId,
    pou: &'a ast::Pou,
    symbols: &'a Symbols,
    labels: BTreeMap<String, usize>,
}

/// A rule reports what breaks it.
type Rule = fn(&Context<'_>) -> Vec<Diagnostic>;

/// The static rules. They are independent: each runs whatever the others found.
const RULES: &[Rule] = &[
    rule_constants_have_values::apply,
    rule_constants_not_written::apply,
    rule_control_outside_parentheses::apply,
    rule_inputs_not_written::apply,
    rule_instructions_reachable::apply,
    rule_jumps_forward::apply,
    rule_labels_defined::apply,
    rule_labels_unique::apply,
    rule_labels_used::apply,
    rule_parentheses_begin_with_value::apply,
    rule_result_defined::apply,
    rule_results_used::apply,
    rule_variables_used::apply,
];

/// Checks the program of a file with all it calls. It is `None` exactly if one of the diagnostics, or one found while
/// reading the text, is an error; `clean` says that reading found none.
#[must_use]
pub fn check(unit: &Unit, clean: bool) -> (Option<Program>, Vec<Diagnostic>) {
    let (project, mut diagnostics, mut of_units) = Project::of(unit);
    let Some(entry) = entry(&project, &mut diagnostics) else { return (None, diagnostics) };
    let needed = project.reachable(entry, &mut diagnostics);
    let mut pous: Vec<Pou> = project.pous.iter().enumerate().map(|(i, pou)| empty(&project, PouId(i), pou)).collect();
    for &id in &needed {
        let pou = project.pou(id);
        if let Some((language, span)) = &pou.foreign {
            diagnostics.push(foreign(pou, language, *span));
            continue;
        }
        let labels = control_flow::labels(&pou.body);
        let context = Context { project: &project, id, pou, symbols: project.symbols(id), labels };
        let typed = typing::unit(&context);
        if !project.is_library(id) {
            diagnostics.append(&mut of_units[id.0]);
            diagnostics.extend(typed.diagnostics);
            diagnostics.extend(RULES.iter().flat_map(|rule| rule(&context)));
        }
        pous[id.0].body = typed.body;
        pous[id.0].types = typed.types;
        pous[id.0].literals = typed.literals;
    }
    diagnostics.extend(not_checked(&project, &needed));
    let interval = interval::of(unit, &project.pou(entry).name, &mut diagnostics);
    diagnostics.sort_by_key(Diagnostic::span);
    diagnostics.dedup();
    if !clean || any_error(&diagnostics) {
        // What is not used may be used where the errors are.
        diagnostics.retain(|diagnostic| !is_about_use(diagnostic.code));
        return (None, diagnostics);
    }
    let globals = variables(&project.globals);
    let program = Program { pous, entry, globals, interval };
    if let Some(what) = expansion::too_large(&program, &needed) {
        let name = &project.pou(entry).name;
        let message = format!("`{}` has {what} when its calls are written out", name.text);
        let help = "every call is modelled by instructions of its own; check its parts one by one";
        diagnostics.push(Diagnostic::new(Code::ProgramTooLarge, name.span, message).help(help));
        return (None, diagnostics);
    }
    (Some(program), diagnostics)
}

/// Whether a code is about something that is written and not used.
fn is_about_use(code: Code) -> bool {
    matches!(
        code,
        Code::VariableNotUsed
            | Code::VariableNotWritten
            | Code::OutputNotWritten
            | Code::ResultNotUsed
            | Code::LabelNotUsed
    )
}

/// The one PROGRAM of the file; where there is none, the last function block or function that no other calls.
fn entry(project: &Project<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<PouId> {
    let own = || project.unit.pous.iter().enumerate().map(|(i, pou)| (PouId(i), pou));
    let mut programs = own().filter(|(_, pou)| pou.kind == PouKind::Program);
    if let Some((id, program)) = programs.next() {
        diagnostics.extend(programs.map(|(_, second)| {
            Diagnostic::new(Code::SeveralPrograms, second.name.span, "this file declares a second program")
                .also(program.name.span, "the first is here")
                .help("put each program in a file of its own")
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
    let message = format!("`{}` is written in {language}, not in Instruction List", pou.name.text);
    let help = match language {
        "Structured Text" => "only Instruction List is read: instead of `q := a AND b;` write `LD a`, `AND b`, `ST q`",
        _ => "only Instruction List is read",
    };
    Diagnostic::new(Code::OtherLanguage, span, message).help(help)
}

/// Units of the file that are not needed.
fn not_checked<'a>(project: &'a Project<'_>, needed: &'a [PouId]) -> impl Iterator<Item = Diagnostic> + 'a {
    let needed: BTreeSet<PouId> = needed.iter().copied().collect();
    let others = project.unit.pous.iter().enumerate().filter(move |(i, pou)| {
        !needed.contains(&PouId(*i)) && pou.kind != PouKind::Program && !pou.name.text.is_empty()
    });
    others.map(|(_, pou)| {
        let message = format!("{} `{}` is not called by the program and is not checked", pou.kind, pou.name.text);
        Diagnostic::new(Code::PouNotChecked, pou.name.span, message)
    })
}

fn empty(project: &Project<'_>, id: PouId, pou: &ast::Pou) -> Pou {
    Pou {
        name: pou.name.text.clone(),
        kind: pou.kind,
        is_library: project.is_library(id),
        variables: variables(project.symbols(id)),
        body: Vec::new(),
        types: Vec::new(),
        literals: Vec::new(),
    }
}

fn variables(symbols: &Symbols) -> Vec<Variable> {
    let variables = symbols.list().iter().map(|symbol| Variable {
        name: symbol.name.clone(),
        section: symbol.section,
        // A broken declaration has been reported, and no program comes of it.
        shape: symbol.shape.clone().unwrap_or(Shape::Scalar(Scalar::new(Type::BOOL))),
        initial: symbol.initial.clone(),
        area: symbol.area,
        span: symbol.span,
    });
    variables.collect()
}

/// The label's instruction.
fn target(labels: &BTreeMap<String, usize>, name: &Name) -> Option<usize> {
    labels.get(&name.key()).copied()
}
