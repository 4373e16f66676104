//! Literals that never decide an output because of the restrictions.

use rustc_hash::FxHashSet;

use super::super::formula::{Formula, SignalId};
use super::super::solver::Answer;
use super::super::specification::{Kind, Specification};
use super::effects::{differs, roots};
use super::finding::{Doubt, Finding};
use super::model::{Change, Model, Occurrence};
use super::outputs::equation;

/// Occurrence of a signal in a formula.
struct Literal {
    signal: SignalId,
    /// Whether the occurrence is negated.
    is_negated: bool,
}

/// Literals of a function that decide none of its outputs or resets: negating one changes none of them in any allowed
/// valuation. Literals of excluded causes are skipped.
pub fn never_decide(
    model: &mut Model<'_>,
    function: usize,
    constant: &[SignalId],
    removed: &FxHashSet<Occurrence>,
) -> Vec<Finding> {
    let mut findings = Vec::new();
    let specification = model.specification;
    let roots = roots(specification, function, constant);
    for (occurrence, literal, nth) in occurrences(specification, function) {
        if removed.contains(&occurrence) || constant.contains(&occurrence.of) {
            continue;
        }
        if model.is_stopped() {
            let question = format!("each literal of `{}` decides", specification.name(occurrence.of));
            findings.push(Finding::open(equation(specification, occurrence.of), question).of(function));
            break;
        }
        let changed = model.changed(Change::Occurrence(occurrence));
        let differs = differs(model, &changed, &roots);
        let place = equation(specification, occurrence.of);
        match model.ask_allowed(&[differs]) {
            Answer::Satisfiable => {}
            Answer::Unsatisfiable => {
                let about = model.cone.inputs.clone();
                let (core, example) = model.explained(&[differs], &about);
                if core.is_empty() {
                    continue;
                }
                let written = Formula::Signal(literal.signal);
                let written = if literal.is_negated { written.negated() } else { written };
                let finding = Finding::new(Doubt::NeverDecides, place).of(function);
                let finding = finding.signals([occurrence.of, literal.signal]).formula(written);
                findings.push(Finding { nth, ..finding.because(core, example) });
            }
            Answer::Stopped => {
                let (name, of) = (specification.name(literal.signal), specification.name(occurrence.of));
                findings.push(Finding::open(place, format!("`{name}` in `{of}` ever decides")).of(function));
            }
        }
    }
    findings
}

/// Literals of a function's equations and reset conditions, each numbered if its signal occurs several times.
fn occurrences(specification: &Specification, function: usize) -> Vec<(Occurrence, Literal, Option<usize>)> {
    let mut all = Vec::new();
    for &of in &specification.functions[function].equations {
        let Kind::Defined { formula, latched, .. } = &specification.signal(of).kind else { continue };
        for (formula, in_reset) in std::iter::once((formula, false)).chain(latched.as_ref().map(|reset| (reset, true)))
        {
            let mut literals = Vec::new();
            walk(formula, false, &mut literals);
            let signals: Vec<SignalId> = literals.iter().map(|literal| literal.signal).collect();
            for (at, literal) in literals.into_iter().enumerate() {
                let is_same = |other: &&SignalId| **other == literal.signal;
                let several = signals.iter().filter(is_same).count() > 1;
                let nth = several.then(|| signals[..=at].iter().filter(is_same).count());
                all.push((Occurrence { of, in_reset, at }, literal, nth));
            }
        }
    }
    all
}

/// Collects the literals from left to right.
fn walk(formula: &Formula, is_negated: bool, literals: &mut Vec<Literal>) {
    match formula {
        Formula::Constant(_) => {}
        Formula::Signal(signal) => literals.push(Literal { signal: *signal, is_negated }),
        Formula::Not(inner) => walk(inner, true, literals),
        Formula::Gate(_, operands) => operands.iter().for_each(|operand| walk(operand, false, literals)),
    }
}
