//! Export of a specification as requirements on a program, for `petril check`: verification by exploration, independent
//! of the proof by gates, which also decides delays.

use std::fmt::Write;

use super::formula::{Formula, Operator};
use super::specification::{Binding, Kind, Scope, Signal, Specification};

/// Text of a requirement file. Restrictions of the whole system become assumptions; those of a zone or a function
/// become premises of its requirements, which all scans so far have to satisfy. Outputs have the names of the program's
/// variables, also in other formulas; auxiliary values are expanded.
#[must_use]
pub fn requirements(specification: &Specification) -> String {
    let mut text = String::new();
    if let Some(title) = &specification.title {
        let _ = writeln!(text, "// {title}\n");
    }
    let written = |formula: &Formula| formula_text(specification, formula);
    for restriction in specification.restrictions.iter().filter(|restriction| restriction.scope == Scope::System) {
        let (name, sentence) = (&restriction.name, quoted(restriction.sentence.as_deref()));
        let _ = writeln!(text, "assume {name}{sentence}: {};", written(&restriction.allowed));
    }
    for (position, function) in specification.functions.iter().enumerate() {
        let scoped = specification.restrictions_of(position).filter(|restriction| restriction.scope != Scope::System);
        let premise: Vec<Formula> = scoped.map(|restriction| restriction.allowed.clone()).collect();
        let about = |conclusion: String| match premise.as_slice() {
            [] => format!("AG ({conclusion})"),
            premise => {
                let all: Vec<String> = premise.iter().map(|formula| format!("({})", written(formula))).collect();
                format!("AG (so_far({}) -> ({conclusion}))", all.join(" & "))
            }
        };
        for &output in &function.outputs {
            let signal = specification.signal(output);
            let Kind::Defined { formula, latched, delayed, .. } = &signal.kind else { continue };
            let (name, formula) = (variable(signal), written(formula));
            // Nothing is latched before the first scan, whatever the variable's initial value is.
            let before = format!("pre({name}) & !at first scan");
            let is_one = function.outputs.len() == 1;
            let title = if is_one { function.title.as_deref() } else { signal.description.as_deref() };
            let mut require = |name: String, conclusion: String| {
                let _ = writeln!(
                    text,
                    "requirement {name}{} [function: {}]:\n    {};",
                    quoted(title),
                    function.name,
                    about(conclusion)
                );
            };
            match (latched, delayed) {
                (None, None) => require(signal.name.clone(), format!("{name} <-> ({formula})")),
                (Some(reset), None) => {
                    let reset = written(reset);
                    require(signal.name.clone(), format!("{name} <-> ({formula}) | {before} & !({reset})"));
                }
                (latched, Some(delay)) => {
                    let only = match latched {
                        None => format!("{name} -> ({formula})"),
                        Some(_) => format!("{name} -> ({formula}) | {before}"),
                    };
                    require(format!("{}_only_if", signal.name), only);
                    require(format!("{}_in_time", signal.name), format!("held({formula}, T#{delay}ms) -> {name}"));
                }
            }
        }
    }
    text
}

/// Quoted text after a name.
fn quoted(text: Option<&str>) -> String {
    text.map(|text| format!(" \"{}\"", text.replace('"', "'"))).unwrap_or_default()
}

/// Name of a signal in the program; its own name if only an address is known.
fn variable(signal: &Signal) -> &str {
    match &signal.binding {
        Some(Binding::Variable(name, _)) => name,
        _ => &signal.name,
    }
}

fn formula_text(specification: &Specification, formula: &Formula) -> String {
    plain(specification, formula).text(&|signal| variable(specification.signal(signal)))
}

/// Rewrites a formula to the operators of requirements, with auxiliary values expanded.
fn plain(specification: &Specification, formula: &Formula) -> Formula {
    let gate = |operator, operands| Formula::Gate(operator, operands);
    match formula {
        Formula::Constant(_) => formula.clone(),
        Formula::Signal(signal) => match &specification.signal(*signal).kind {
            Kind::Defined { is_output: false, formula, .. } => plain(specification, formula),
            _ => formula.clone(),
        },
        Formula::Not(inner) => plain(specification, inner).negated(),
        Formula::Gate(operator, operands) => {
            let mut operands: Vec<Formula> = operands.iter().map(|operand| plain(specification, operand)).collect();
            match operator {
                Operator::And | Operator::Or | Operator::Implies | Operator::Iff => gate(*operator, operands),
                Operator::Xor => {
                    let first = operands.remove(0);
                    operands.into_iter().fold(first, |odd, operand| gate(Operator::Iff, vec![odd, operand]).negated())
                }
                Operator::AtMostOne => at_most_one(&operands),
                Operator::ExactlyOne => {
                    let one = gate(Operator::Or, operands.clone());
                    gate(Operator::And, vec![one, at_most_one(&operands)])
                }
            }
        }
    }
}

/// Each operand excludes those after it.
fn at_most_one(operands: &[Formula]) -> Formula {
    let pairs = (1..operands.len()).map(|next| {
        let later = match &operands[next..] {
            [last] => last.clone(),
            later => Formula::Gate(Operator::Or, later.to_vec()),
        };
        Formula::Gate(Operator::And, vec![operands[next - 1].clone(), later]).negated()
    });
    let pairs: Vec<Formula> = pairs.collect();
    if pairs.is_empty() { Formula::Constant(true) } else { Formula::Gate(Operator::And, pairs) }
}
