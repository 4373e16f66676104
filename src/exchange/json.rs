//! Reports as JSON, for programs. Field names are part of the interface: they are only ever added to. The schema is
//! `docs/schema/report.schema.json`.

use serde_json::{Map, Value, json};

use super::checked::{Checked, Purpose, runs, why};
use petril_base::diagnostic::Diagnostic;
use petril_base::source::Source;
use petril_check::translate::{Part, System, TransitionRole};
use petril_check::verdict::{Answer, Change, Coverage, Independence, Outcome, Remark, Trace, Why, Witness};
use petril_check::witness::{Executed, FiringTrace, Scan, ScanTrace, story};
use petril_lang::semantics::{Role, Type, VarId};
use petril_logic::View;

/// Upper bound on the instructions of a last scan that is listed.
const MAX_INSTRUCTIONS: usize = 1 << 20;

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

/// Report of a check; with `by_line`, the last scan of each run is listed instruction by instruction.
#[must_use]
pub fn report(checked: &Checked<'_>, by_line: bool) -> Value {
    let Checked { system, source, report, provenance } = *checked;
    let size = |(places, transitions)| json!({ "places": places, "transitions": transitions });
    let parts: Map<String, Value> =
        Part::ALL.map(|part| (part.name().to_owned(), size(system.size(part)))).into_iter().collect();
    let exploration = &report.exploration;
    let answers = |answers: &[Answer]| answers.iter().map(|a| answer(checked, a, by_line)).collect::<Vec<_>>();
    json!({
        "program": { "name": system.program.name, "file": source.name(), "lines": system.program.end() },
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
            "cached": exploration.recalled,
        },
        "inputs": inputs(system),
        "assumptions": report.assumptions,
        "requirements": answers(&report.answers),
        "checks": answers(&report.checks),
        "notes": report.remarks.iter().map(|r| remark(checked, r)).collect::<Vec<_>>(),
        "coverage": report.coverage.as_ref().map(|found| coverage(checked, found)),
        "verdict": report.verdict().word(),
        "provenance": provenance.json(),
    })
}

fn coverage(checked: &Checked<'_>, coverage: &Coverage) -> Value {
    let names = |ids: &[VarId]| ids.iter().map(|&id| checked.name(id)).collect::<Vec<_>>();
    let never = coverage.never_executed.as_ref();
    json!({
        "lines": coverage.lines,
        "never_executed": never.map(|lines| lines.iter().map(|line| line + 1).collect::<Vec<_>>()),
        "never_read": names(&coverage.never_read),
        "never_written": names(&coverage.never_written),
        "unasked": names(&coverage.unasked),
    })
}

/// Free inputs, each with the number of values tried.
fn inputs(system: &System) -> Vec<Value> {
    let one = |input: VarId| {
        let size = u64::try_from(system.domain(input).size()).unwrap_or(u64::MAX);
        json!({ "name": system.program.variable(input).name, "values": size })
    };
    system.free_inputs().map(one).collect()
}

fn remark(checked: &Checked<'_>, remark: &Remark) -> Value {
    match *remark {
        Remark::NeverChanges(output, pattern) => {
            let value = variable_value(checked.system, output, pattern);
            json!({ "kind": "never-changes", "variable": checked.name(output), "value": value })
        }
        Remark::NeverExecuted(line) => {
            json!({ "kind": "never-executed", "line": line + 1, "source_line": checked.source_line(line) })
        }
    }
}

fn view(view: View) -> &'static str {
    match view {
        View::Scan => "scan",
        View::Transition => "transition",
    }
}

fn answer(checked: &Checked<'_>, answer: &Answer, by_line: bool) -> Value {
    let mut run = None;
    let mut example = None;
    for (purpose, witness) in runs(answer) {
        let slot = if purpose == Purpose::Example { &mut example } else { &mut run };
        *slot = Some(trace(checked, witness, by_line));
    }
    json!({
        "name": answer.name,
        "sentence": answer.sentence,
        "words": answer.words,
        "formula": answer.formula,
        "tags": answer.tags.iter().map(|tag| json!({ "name": tag.name, "value": tag.value })).collect::<Vec<_>>(),
        "origin": answer.origin.as_ref().map(|o| json!({ "file": o.file, "line": o.line, "column": o.column })),
        "verdict": answer.outcome.verdict().word(),
        "cached": answer.recalled,
        "reason": checked.reason(answer),
        "vacuous": matches!(answer.outcome, Outcome::Holds { vacuous: Some(_), .. }),
        "independent_of": answer.independent.map(|what| match what {
            Independence::OfEverything => "everything",
            Independence::OfTheProgram => "program",
        }),
        "why": why(answer).map(|why| explanation(checked, why)),
        "trace": run,
        "example": example,
    })
}

/// Diagnosis of a violation; scans and lines count from 1.
fn explanation(checked: &Checked<'_>, why: &Why) -> Value {
    let value = |variable, pattern| variable_value(checked.system, variable, pattern);
    let writers = why.writers.iter().map(|writer| {
        json!({
            "variable": checked.name(writer.variable),
            "value": value(writer.variable, writer.value),
            "scan": writer.scan + 1,
            "line": writer.line + 1,
            "source_line": checked.source_line(writer.line),
        })
    });
    let changes = |changes: &[Change]| -> Vec<Value> {
        let one = |change: &Change| {
            json!({
                "scan": change.scan + 1,
                "input": checked.name(change.input),
                "from": value(change.input, change.from),
                "to": value(change.input, change.to),
            })
        };
        changes.iter().map(one).collect()
    };
    let repair = why.repair.as_ref().map(|repair| {
        json!({
            "changes": changes(&repair.changes),
            "smallest": repair.is_smallest,
            "others": repair.others.iter().map(|other| changes(other)).collect::<Vec<_>>(),
        })
    });
    json!({
        "wanted": why.wanted,
        "writers": writers.collect::<Vec<_>>(),
        "unwritten": why.unwritten.iter().map(|&id| checked.name(id)).collect::<Vec<_>>(),
        "repair": repair,
        "unrepaired": why.unrepaired,
    })
}

fn trace(checked: &Checked<'_>, witness: &Witness, by_line: bool) -> Value {
    // States of the scan view are ends of scans, which count from 1; the transition view has a state 0 before the first
    // firing.
    let (mut document, from) = match &witness.trace {
        Trace::Scans(trace) => (scans(checked.system, trace), 1),
        Trace::Firings(trace) => (firings(checked.system, trace), 0),
    };
    let notes = witness.notes.iter().map(|n| json!({ "first": n.first + from, "last": n.last + from, "text": n.text }));
    document["notes"] = notes.collect();
    if let (Trace::Scans(trace), true) = (&witness.trace, by_line) {
        // A trace that does not replay has no verdict, and does not get here.
        let last = trace.scans.len().saturating_sub(1);
        let told = story(checked.system, trace, last, MAX_INSTRUCTIONS).unwrap_or_default();
        let lines = told.map(|scans| {
            scans.iter().flat_map(|scan| &scan.instructions).map(|e| executed(checked, e)).collect::<Vec<_>>()
        });
        document["last_scan"] = lines.into();
    }
    document
}

/// An executed instruction. `result` is the current result after it.
fn executed(checked: &Checked<'_>, executed: &Executed) -> Value {
    let writes = executed.writes.map(|(variable, pattern)| {
        json!({
            "variable": checked.name(variable),
            "value": variable_value(checked.system, variable, pattern),
            "changed": executed.changes,
        })
    });
    json!({
        "line": executed.line + 1,
        "source_line": checked.source_line(executed.line),
        "instruction": checked.instruction(executed.line),
        "result": value(executed.ty, executed.result),
        "writes": writes,
        "hazard": executed.hazard.map(|hazard| hazard.to_string()),
    })
}

fn variable_value(system: &System, variable: VarId, pattern: u64) -> Value {
    value(system.program.variable(variable).ty, pattern)
}

/// A Boolean or a number; times are in milliseconds.
fn value(ty: Type, pattern: u64) -> Value {
    let number = ty.number(pattern);
    match (u64::try_from(number), i64::try_from(number)) {
        _ if ty.is_bool() => Value::Bool(pattern == 1),
        (Ok(number), _) => number.into(),
        (_, number) => number.unwrap_or(i64::MIN).into(),
    }
}

/// A run of scans. `loop_start` is the number of the scan whose end the last scan repeats.
fn scans(system: &System, trace: &ScanTrace) -> Value {
    let one = |(position, scan): (usize, &Scan)| {
        let name = |id: VarId| system.program.variable(id).name.clone();
        let value = |id: VarId, pattern: u64| variable_value(system, id, pattern);
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

/// A run of firings. `loop_start` is the number of firings before the marking that the last firing returns to.
fn firings(system: &System, trace: &FiringTrace) -> Value {
    let one = |&transition: &petril_net::net::TransitionId| {
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
