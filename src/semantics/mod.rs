//! From syntax tree to checked program: names resolved, every static rule applied.
//!
//! The static semantics is the list of files `rule_….rs`, one sentence each.

mod control_flow;
mod program;
mod resolve;
mod symbols;
mod types;

mod rule_constants_have_values;
mod rule_constants_not_written;
mod rule_control_outside_parentheses;
mod rule_declarations_supported;
mod rule_initial_values_fit;
mod rule_inputs_not_written;
mod rule_instructions_reachable;
mod rule_labels_defined;
mod rule_labels_unique;
mod rule_labels_used;
mod rule_names_declared;
mod rule_names_unique;
mod rule_operands_counted;
mod rule_operands_fit;
mod rule_operators_supported;
mod rule_parentheses_begin_with_value;
mod rule_result_defined;
mod rule_types_supported;

#[cfg(test)]
mod testing;

pub use program::{Action, Condition, Function, Instruction, Operand, Program, Role, Statement, VarId, Variable};
pub use types::{Kind, Type};

use crate::diagnostic::{Code, Diagnostic, any_error};
use crate::syntax::ast::{Pou, PouKind, Unit};
use symbols::Symbols;

/// What a rule looks at: the program, its names, and the file around it.
struct Context<'a> {
    unit: &'a Unit,
    pou: &'a Pou,
    symbols: &'a Symbols<'a>,
}

/// A rule reports what breaks it.
type Rule = fn(&Context<'_>) -> Vec<Diagnostic>;

/// Every static rule. They are independent: each runs whatever the others found.
const RULES: &[Rule] = &[
    rule_constants_have_values::apply,
    rule_constants_not_written::apply,
    rule_control_outside_parentheses::apply,
    rule_declarations_supported::apply,
    rule_initial_values_fit::apply,
    rule_inputs_not_written::apply,
    rule_instructions_reachable::apply,
    rule_labels_defined::apply,
    rule_labels_unique::apply,
    rule_labels_used::apply,
    rule_names_declared::apply,
    rule_names_unique::apply,
    rule_operands_counted::apply,
    rule_operands_fit::apply,
    rule_operators_supported::apply,
    rule_parentheses_begin_with_value::apply,
    rule_result_defined::apply,
    rule_types_supported::apply,
];

/// Checks the program of a file. It is `None` exactly if one of the diagnostics, or one found while reading the text, is
/// an error; `clean` says that reading found none.
#[must_use]
pub fn check(unit: &Unit, clean: bool) -> (Option<Program>, Vec<Diagnostic>) {
    let mut diagnostics = Vec::new();
    let pou = the_program(unit, &mut diagnostics);
    let Some(pou) = pou else { return (None, diagnostics) };
    let symbols = Symbols::of(pou);
    let context = Context { unit, pou, symbols: &symbols };
    diagnostics.extend(RULES.iter().flat_map(|rule| rule(&context)));
    diagnostics.sort_by_key(Diagnostic::span);
    let program = (clean && !any_error(&diagnostics)).then(|| resolve::program(&context)).flatten();
    (program, diagnostics)
}

/// The one PROGRAM of the file. Other units are not called by it (calls are refused), so they are only mentioned.
fn the_program<'a>(unit: &'a Unit, diagnostics: &mut Vec<Diagnostic>) -> Option<&'a Pou> {
    let (programs, others): (Vec<&Pou>, Vec<&Pou>) = unit.pous.iter().partition(|pou| pou.kind == PouKind::Program);
    let Some(&program) = programs.first() else {
        let pou = others.first()?;
        let message = format!("this file holds no program, only {} `{}`", pou.kind, pou.name.text);
        diagnostics.push(
            Diagnostic::new(Code::NothingToCheck, pou.name.span, message)
                .help("add a `PROGRAM`: functions and function blocks do nothing by themselves"),
        );
        return None;
    };
    diagnostics.extend(programs[1..].iter().map(|second| {
        Diagnostic::new(Code::SeveralPrograms, second.name.span, "this file declares a second program")
            .also(program.name.span, "the first is here")
            .help("put each program in a file of its own")
    }));
    diagnostics.extend(others.iter().map(|pou| {
        let message = format!("{} `{}` is not called by the program and is not checked", pou.kind, pou.name.text);
        Diagnostic::new(Code::PouNotChecked, pou.name.span, message)
    }));
    Some(program)
}
