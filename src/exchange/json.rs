//! Reports as JSON, for programs. Field names are part of the interface: they are only ever added to.

use serde_json::{Map, Value, json};

use crate::diagnostic::Diagnostic;
use crate::logic::View;
use crate::semantics::{Role, Type, VarId};
use crate::source::Source;
use crate::translate::{Part, System, TransitionRole};
use crate::verdict::{Answer, Outcome, Remark, Report, Trace, Witness};
use crate::witness::{FiringTrace, Scan, ScanTrace};

/// A diagnostic: code, severity, message, file, line and column from 1, help.
#[must_use]
pub fn diagnostic(diagnostic: &Diagnostic, source: &Source) -> Value {
    let (line, column) = source.line_column(diagnostic.span().start);
    json!({
        "code": diagnostic.code.id(),
        "severity": if diagnostic.is_error() { "error" } else { "warning" },
        "message": diagnostic.message,
        "file": source.name(),
        "line": line,
        "column": column,
        "help": diagnostic.help,
    })
}

/// The report of a check. `file` is the name of the program's file.
#[must_use]
pub fn report(system: &System, report: &Report, file: &str) -> Value {
    let size = |(places, transitions)| json!({ "places": places, "transitions": transitions });
    let parts: Map<String, Value> =
        Part::ALL.map(|part| (part.name().to_owned(), size(system.size(part)))).into_iter().collect();
    let exploration = &report.exploration;
    let answers = |answers: &[Answer]| answers.iter().map(|a| answer(system, a, exploration.view)).collect::<Vec<_>>();
    json!({
        "program": { "name": system.program.name, "file": file, "lines": system.program.end() },
        "net": {
            "places": system.net.places().len(),
            "transitions": system.net.transitions().len(),
            "parts": parts,
        },
        "exploration": {
            "view": view(exploration.view),
            "states": exploration.states,
            "steps": exploration.steps,
            "depth": exploration.depth,
            "complete": exploration.complete,
            "stop": exploration.stop.to_string(),
            "bytes": exploration.bytes,
        },
        "inputs": inputs(system),
        "assumptions": report.assumptions,
        "requirements": answers(&report.answers),
        "checks": answers(&report.checks),
        "notes": report.remarks.iter().map(|r| remark(system, r)).collect::<Vec<_>>(),
        "verdict": report.verdict().word(),
    })
}

/// The free inputs, each with the number of values that were tried.
fn inputs(system: &System) -> Vec<Value> {
    let one = |input: VarId| {
        let size = u64::try_from(system.domain(input).size()).unwrap_or(u64::MAX);
        json!({ "name": system.program.variable(input).name, "values": size })
    };
    system.free_inputs().map(one).collect()
}

fn remark(system: &System, remark: &Remark) -> Value {
    match *remark {
        Remark::NeverChanges(output, pattern) => {
            let output = system.program.variable(output);
            json!({ "kind": "never-changes", "variable": output.name, "value": value(output.ty, pattern) })
        }
        Remark::NeverExecuted(line) => json!({ "kind": "never-executed", "line": line + 1 }),
    }
}

fn view(view: View) -> &'static str {
    match view {
        View::Scan => "scan",
        View::Transition => "transition",
    }
}

fn answer(system: &System, answer: &Answer, view: View) -> Value {
    let witness = answer.outcome.witness();
    let reason = match &answer.outcome {
        Outcome::Unknown(reason) => Some(reason.clone()),
        Outcome::Holds { vacuous: Some(vacuity), .. } => Some(format!("vacuous: {}", vacuity.sentence())),
        Outcome::Holds { .. } => None,
        Outcome::Violated(witness, _) => {
            Some(witness.notes.iter().map(|note| note.sentence(view)).collect::<Vec<_>>().join("; "))
        }
    };
    json!({
        "name": answer.name,
        "sentence": answer.sentence,
        "formula": answer.formula,
        "verdict": answer.outcome.verdict().word(),
        "reason": reason,
        "vacuous": matches!(answer.outcome, Outcome::Holds { vacuous: Some(_), .. }),
        "trace": witness.map(|witness| trace(system, witness)),
    })
}

fn trace(system: &System, witness: &Witness) -> Value {
    // States of the scan view are the ends of scans, which count from 1; before the first firing there is a state 0.
    let (mut document, from) = match &witness.trace {
        Trace::Scans(trace) => (scans(system, trace), 1),
        Trace::Firings(trace) => (firings(system, trace), 0),
    };
    let notes = witness.notes.iter().map(|n| json!({ "first": n.first + from, "last": n.last + from, "text": n.text }));
    document["notes"] = notes.collect();
    document
}

/// A truth value, or a number; times count milliseconds.
fn value(ty: Type, pattern: u64) -> Value {
    let number = ty.number(pattern);
    match (u64::try_from(number), i64::try_from(number)) {
        _ if ty.is_bool() => Value::Bool(pattern == 1),
        (Ok(number), _) => number.into(),
        (_, number) => number.unwrap_or(i64::MIN).into(),
    }
}

/// `loop_start` is the number of the scan whose end the last scan repeats.
fn scans(system: &System, trace: &ScanTrace) -> Value {
    let one = |(position, scan): (usize, &Scan)| {
        let name = |id: VarId| system.program.variable(id).name.clone();
        let value = |id: VarId, pattern: u64| value(system.program.variable(id).ty, pattern);
        let values = |role| -> Map<String, Value> {
            let end = scan
                .end
                .iter()
                .flat_map(|end| system.program.with_role(role).map(|id| (name(id), value(id, end.memory[id.0]))));
            end.collect()
        };
        let inputs: Map<String, Value> =
            scan.inputs.iter().map(|&(id, pattern)| (name(id), value(id, pattern))).collect();
        let moves = scan.moves.iter().map(|m| &system.plant.components[m.component].transitions[m.transition].name);
        let mut document = json!({
            "scan": position + 1,
            "plant": moves.collect::<Vec<_>>(),
            "inputs": inputs,
            "memory": values(Role::Memory),
            "outputs": values(Role::Output),
            "ends": scan.end.is_some(),
        });
        if let Some((line, hazard)) = scan.hazard {
            document["hazard"] = json!({ "kind": hazard.to_string(), "line": line + 1 });
        }
        document
    };
    json!({
        "kind": "scans",
        "loop_start": trace.loop_start.map(|start| start + 1),
        "scans": trace.scans.iter().enumerate().map(one).collect::<Vec<_>>(),
    })
}

/// `loop_start` is the number of firings after which the marking was the one the last firing leads to.
fn firings(system: &System, trace: &FiringTrace) -> Value {
    let one = |&transition: &crate::net::TransitionId| {
        let role = system.transitions[transition.index()];
        let line = match role {
            TransitionRole::Line(line) => Some(line + 1),
            _ => None,
        };
        json!({
            "transition": system.net.transition(transition).name,
            "part": role.part().name(),
            "line": line,
        })
    };
    json!({
        "kind": "firings",
        "loop_start": trace.loop_start,
        "firings": trace.firings.iter().map(one).collect::<Vec<_>>(),
    })
}
