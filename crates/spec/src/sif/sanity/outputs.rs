//! Constant outputs, and latched outputs that are never reset.

use super::super::formula::SignalId;
use super::super::solver::Answer;
use super::super::specification::{Kind, Place, Specification};
use super::finding::{Doubt, Finding};
use super::model::Model;

/// Constant outputs of a function, as findings and as a list. The list is `None` if a question is open; then further
/// questions are pointless.
pub fn constant(model: &mut Model<'_>, function: usize) -> (Vec<Finding>, Option<Vec<SignalId>>) {
    let (mut findings, mut constant) = (Vec::new(), Vec::new());
    let specification = model.specification;
    for &output in &specification.functions[function].outputs {
        let formula = model.values.formula[output.0];
        for value in [false, true] {
            // Can the output have the other value?
            let wanted = [if value { !formula } else { formula }];
            let place = equation(specification, output);
            match model.ask_allowed(&wanted) {
                Answer::Satisfiable => {}
                Answer::Unsatisfiable => {
                    let about = model.cone.inputs.clone();
                    let (core, example) = model.explained(&wanted, &about);
                    let finding =
                        Finding { value, ..Finding::new(Doubt::Constant, place).of(function).signals([output]) };
                    let finding = match specification.definition(output) {
                        Some(formula) => finding.formula(formula.clone()),
                        None => finding,
                    };
                    findings.push(finding.because(core, example));
                    constant.push(output);
                    break;
                }
                Answer::Stopped => {
                    let other = if value { "FALSE" } else { "TRUE" };
                    let question = format!("`{}` is ever {other}", specification.name(output));
                    findings.push(Finding::open(place, question).of(function));
                    return (findings, None);
                }
            }
        }
    }
    (findings, Some(constant))
}

/// Latched outputs of a function, except constant ones, that are never reset: the reset condition is FALSE, or has no
/// effect because the formula is TRUE.
pub fn resets(model: &mut Model<'_>, function: usize, constant: &[SignalId]) -> Vec<Finding> {
    let mut findings = Vec::new();
    let specification = model.specification;
    for &output in specification.functions[function].outputs.iter().filter(|output| !constant.contains(output)) {
        let Kind::Defined { latched: Some(reset), .. } = &specification.signal(output).kind else { continue };
        let place = specification.signal(output).place;
        let wanted = [model.values.reset[output.0], !model.values.formula[output.0]];
        match model.ask_allowed(&wanted) {
            Answer::Satisfiable => {}
            Answer::Unsatisfiable => {
                let about = model.cone.inputs.clone();
                let (core, example) = model.explained(&wanted, &about);
                let finding = Finding::new(Doubt::ResetNever, place).of(function).signals([output]);
                findings.push(finding.formula(reset.clone()).because(core, example));
            }
            Answer::Stopped => {
                let question = format!("`{}` is ever reset", specification.name(output));
                findings.push(Finding::open(place, question).of(function));
            }
        }
    }
    findings
}

/// Place of a signal's equation.
pub fn equation(specification: &Specification, id: SignalId) -> Place {
    match &specification.signal(id).kind {
        Kind::Defined { place, .. } => *place,
        Kind::Input { .. } => specification.signal(id).place,
    }
}
