//! Data of the page, as one JSON document.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use super::runs::{Runs, shown};
use crate::exchange::VERSION;
use crate::exchange::checked::{Checked, runs, tags, why};
use crate::exchange::stamp::Stamp;
use petril_base::source::Source;
use petril_check::translate::Part;
use petril_check::verdict::{Answer, Outcome, Remark, Why};
use petril_lang::semantics::{Role, VarId};
use petril_logic::View;
use petril_search::Stop;

/// Upper bound on the length of a program's text that is shown whole.
const MAX_SOURCE: usize = 400_000;

/// Builds the document of a report.
pub fn document(checked: &Checked<'_>, stamp: Stamp) -> Value {
    let Checked { system, source, report, provenance } = *checked;
    let program = &system.program;
    let mut runs = Runs::new(*checked);
    // Violated requirements get room first.
    let requirements = report.answers.iter().map(|answer| (answer, "requirement"));
    let all: Vec<(&Answer, &str)> = requirements.chain(report.checks.iter().map(|check| (check, "check"))).collect();
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by_key(|&i| std::cmp::Reverse(all[i].0.outcome.verdict()));
    let mut answers = vec![Value::Null; all.len()];
    for i in order {
        answers[i] = answer(checked, all[i].0, all[i].1, &mut runs);
    }
    let sizes = Part::ALL.map(|part| {
        let (places, transitions) = system.size(part);
        json!([part.name(), places, transitions])
    });
    let variables: Vec<Value> = shown(system)
        .map(|id| {
            let variable = program.variable(id);
            let initial = match variable.ty.is_bool() {
                true => variable.initial.into(),
                false => Value::from(program.value_text(id, variable.initial)),
            };
            json!([variable.name, role(variable.role), variable.ty.to_string(), initial])
        })
        .collect();
    let code: Vec<Value> =
        (0..program.end()).map(|line| json!([checked.source_line(line), checked.instruction(line)])).collect();
    json!({
        "petril": VERSION,
        "provenance": provenance.pairs(),
        "made": format!("{stamp}Z"),
        "took": stamp.took,
        "program": program.name,
        "file": source.name(),
        "view": if checked.view() == View::Scan { "scan" } else { "transition" },
        "verdict": report.verdict().word(),
        "explored": explored(checked),
        "complete": report.exploration.complete,
        "covered": covered(checked),
        "assumptions": report.assumptions,
        "warnings": report.warnings,
        "remarks": remarks(checked),
        "net": sizes,
        "variables": variables,
        "code": code,
        "answers": answers,
        "source": lines(checked),
        "nets": runs.nets.finish(),
    })
}

fn role(role: Role) -> &'static str {
    match role {
        Role::Input => "input",
        Role::Output => "output",
        _ => "memory",
    }
}

fn explored(checked: &Checked<'_>) -> Value {
    let exploration = &checked.report.exploration;
    let (state, step, deep) = match exploration.view {
        View::Scan => ("state at the end of a scan", "step", "scan"),
        View::Transition => ("reachable marking", "firing", "firing"),
    };
    let how = match (&exploration.stop, exploration.complete) {
        (Stop::Complete, false) => "every state was explored, but none behind a scan that goes wrong".to_owned(),
        (stop, _) => stop.to_string(),
    };
    json!([[state, exploration.states], [step, exploration.steps], [deep, exploration.depth], how])
}

fn remarks(checked: &Checked<'_>) -> Vec<Value> {
    let mut seen = BTreeSet::new();
    let one = |remark: &Remark| match *remark {
        Remark::NeverChanges(output, pattern) => {
            let value = checked.system.program.value_text(output, pattern);
            Some(json!([format!("{} is {value} at the end of every scan", checked.name(output)), null]))
        }
        Remark::NeverExecuted(line) => {
            let line = checked.source_line(line);
            let text = checked.source.line_text(line).trim();
            seen.insert(line).then(|| json!([format!("line {line} is never executed: {text}"), line]))
        }
    };
    let mut remarks: Vec<Value> = checked.report.remarks.iter().filter_map(one).collect();
    if let Some(coverage) = &checked.report.coverage {
        let lists = [
            ("no instruction reads", &coverage.never_read),
            ("no instruction writes", &coverage.never_written),
            ("no requirement speaks of", &coverage.unasked),
        ];
        remarks.extend(lists.into_iter().filter(|(_, ids)| !ids.is_empty()).map(|(what, ids)| {
            let names: Vec<String> = ids.iter().map(|&id| format!("`{}`", checked.name(id))).collect();
            json!([format!("{what} {}", names.join(", ")), null])
        }));
    }
    remarks
}

/// Number of lines of flat code, and of those that some scan executes, if known.
fn covered(checked: &Checked<'_>) -> Value {
    let coverage = checked.report.coverage.as_ref();
    let executed = coverage.and_then(|c| Some(c.lines - c.never_executed.as_ref()?.len()));
    json!([checked.system.program.end(), executed])
}

fn answer(checked: &Checked<'_>, answer: &Answer, kind: &str, all: &mut Runs<'_>) -> Value {
    let mut document = json!({
        "name": answer.name,
        "kind": kind,
        "verdict": answer.outcome.verdict().word(),
        "known": answer.recalled,
        "vacuous": matches!(answer.outcome, Outcome::Holds { vacuous: Some(_), .. }),
        "formula": answer.formula,
        "runs": runs(answer).map(|(purpose, witness)| all.run(answer, purpose, witness)).collect::<Vec<_>>(),
    });
    let mut set = |member: &str, value: Option<Value>| {
        if let Some(value) = value {
            document[member] = value;
        }
    };
    set("sentence", answer.sentence.clone().map(Value::from));
    set("words", answer.words.clone().map(Value::from));
    set("remark", answer.remark.clone().map(Value::from));
    set("reason", checked.reason(answer).map(Value::from));
    set("tags", Some(tags(answer).collect::<Vec<_>>()).filter(|tags| !tags.is_empty()).map(Value::from));
    set("origin", checked.file_of(answer).map(|o| format!("{}:{}:{}", o.file, o.line, o.column).into()));
    set("why", why(answer).map(|why| explanation(checked, why)));
    document
}

/// Diagnosis of a violation; scans and lines count from 0, as in runs.
fn explanation(checked: &Checked<'_>, why: &Why) -> Value {
    let program = &checked.system.program;
    let position = |id: VarId| shown(checked.system).position(|own| own == id);
    let writers = why.writers.iter().map(|writer| {
        let value = program.value_text(writer.variable, writer.value);
        json!([checked.name(writer.variable), value, writer.scan, writer.line])
    });
    let repair = why.repair.as_ref().map(|repair| {
        let changes = repair.changes.iter().map(|change| {
            let value = |pattern| program.value_text(change.input, pattern);
            let (from, to) = (value(change.from), value(change.to));
            json!([change.scan, position(change.input), checked.name(change.input), from, to])
        });
        let others = repair.others.iter().map(|others| checked.changes(others));
        json!({
            "changes": changes.collect::<Vec<_>>(),
            "smallest": repair.is_smallest,
            "others": others.collect::<Vec<_>>(),
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

/// Text of the program: all lines or, if it is long, the lines with instructions and two lines around each, with their
/// numbers.
fn lines(checked: &Checked<'_>) -> Value {
    let source = checked.source;
    let count = source.line_of(source.text().len());
    if source.text().len() <= MAX_SOURCE {
        return (1..=count).map(|line| text_of(source, line)).collect();
    }
    let wanted = (0..checked.system.program.end()).flat_map(|line| {
        let line = checked.source_line(line);
        line.saturating_sub(2).max(1)..=(line + 2).min(count)
    });
    let wanted: BTreeSet<usize> = wanted.collect();
    let mut room = MAX_SOURCE;
    let kept = wanted.into_iter().take_while(|&line| {
        room = room.saturating_sub(source.line_text(line).len() + 8);
        room > 0
    });
    kept.map(|line| json!([line, text_of(source, line)])).collect()
}

/// Text of a line, indentation included.
fn text_of(source: &Source, line: usize) -> &str {
    source.slice(source.lines(line, line)).trim_end()
}
