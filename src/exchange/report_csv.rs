//! Reports as tables (CSV, RFC 4180), one row for each requirement, check, assumption and warning; and the inputs of a
//! run, one row per scan, as read by `petril simulate --inputs`.

use super::checked::{Checked, runs, tags, why};
use super::{Provenance, table};
use petril_check::translate::System;
use petril_check::verdict::{Answer, Outcome, Trace};
use petril_check::witness::firing_story;
use petril_lang::semantics::{Role, VarId};

/// Columns of a report.
const COLUMNS: [&str; 21] = [
    "kind",
    "name",
    "verdict",
    "vacuous",
    "reason",
    "run",
    "length",
    "repeats",
    "written_at",
    "repair",
    "sentence",
    "words",
    "formula",
    "tags",
    "file",
    "line",
    "known",
    "tool",
    "inputs",
    "options",
    "command",
];

/// Writes a report. `length` counts scans, or firings in the transition view; `repeats` is the one that the last one
/// returns to; `written_at` lists the source lines that wrote the values at fault; `known` says whether the answer
/// comes from an earlier run; `inputs` lists the files read, each with its SHA-256, and `options` is the SHA-256 of all
/// options. Assumptions and warnings have rows of their own after the others, with the text in the column `sentence`.
#[must_use]
pub fn write(checked: &Checked<'_>) -> String {
    let kinds = [("requirement", &checked.report.answers), ("check", &checked.report.checks)];
    let rows = kinds.into_iter().flat_map(|(kind, answers)| answers.iter().map(move |answer| (kind, answer)));
    let rows = rows.map(|(kind, answer)| row(checked, kind, answer));
    let said = [("assumption", &checked.report.assumptions), ("warning", &checked.report.warnings)];
    let said = said.into_iter().flat_map(|(kind, texts)| texts.iter().map(move |text| said_row(checked, kind, text)));
    table::write(std::iter::once(COLUMNS.map(str::to_owned).to_vec()).chain(rows).chain(said))
}

/// A row with a kind and a sentence, and where it comes from.
fn said_row(checked: &Checked<'_>, kind: &str, sentence: &str) -> Vec<String> {
    let cell = |column: &str| match column {
        "kind" => kind.to_owned(),
        "sentence" => sentence.to_owned(),
        "tool" => Provenance::tool(),
        "inputs" => checked.provenance.files(),
        "options" => checked.provenance.options.clone(),
        "command" => checked.provenance.command_line(),
        _ => String::new(),
    };
    COLUMNS.map(cell).to_vec()
}

fn row(checked: &Checked<'_>, kind: &str, answer: &Answer) -> Vec<String> {
    let run = runs(answer).next();
    let (length, repeats) = match run.map(|(_, witness)| &witness.trace) {
        Some(Trace::Scans(trace)) => (Some(trace.scans.len()), trace.loop_start.map(|start| start + 1)),
        Some(Trace::Firings(trace)) => (Some(trace.firings.len()), trace.loop_start),
        None => (None, None),
    };
    let number = |number: Option<usize>| number.map(|number| number.to_string()).unwrap_or_default();
    let why = why(answer);
    let writers = why.iter().flat_map(|why| &why.writers).map(|w| checked.source_line(w.line).to_string());
    let repair = why.and_then(|why| why.repair.as_ref()).map(|repair| {
        let program = &checked.system.program;
        let changes = repair.changes.iter().map(|change| {
            let value = program.value_text(change.input, change.to);
            format!("{} = {value} in scan {}", checked.name(change.input), change.scan + 1)
        });
        changes.collect::<Vec<_>>().join("; ")
    });
    vec![
        kind.to_owned(),
        answer.name.clone(),
        answer.outcome.verdict().word().to_owned(),
        matches!(answer.outcome, Outcome::Holds { vacuous: Some(_), .. }).to_string(),
        checked.reason(answer).unwrap_or_default(),
        run.map(|(purpose, _)| purpose.word().to_owned()).unwrap_or_default(),
        number(length),
        number(repeats),
        writers.collect::<Vec<_>>().join("; "),
        repair.unwrap_or_default(),
        answer.sentence.clone().unwrap_or_default(),
        answer.words.clone().unwrap_or_default(),
        answer.formula.clone(),
        tags(answer).collect::<Vec<_>>().join("; "),
        answer.origin.as_ref().map(|origin| origin.file.clone()).unwrap_or_default(),
        number(answer.origin.as_ref().map(|origin| origin.line)),
        answer.recalled.to_string(),
        Provenance::tool(),
        checked.provenance.files(),
        checked.provenance.options.clone(),
        checked.provenance.command_line(),
    ]
}

/// Inputs of a run, for `petril simulate --inputs`: a row of names, then a row for each scan that begins. Booleans are
/// 0 and 1, times are in milliseconds.
#[must_use]
pub fn inputs(system: &System, trace: &Trace) -> String {
    let program = &system.program;
    let inputs: Vec<VarId> = program.with_role(Role::Input).collect();
    let mut values: Vec<u64> = inputs.iter().map(|&id| program.variable(id).initial).collect();
    let mut rows = vec![inputs.iter().map(|&id| program.variable(id).name.clone()).collect()];
    let row = |values: &[u64]| -> Vec<String> {
        let numbers = inputs.iter().zip(values).map(|(&id, &value)| program.variable(id).ty.number(value).to_string());
        numbers.collect()
    };
    let copy = |values: &mut Vec<u64>, input: VarId, value: u64| {
        if let Some(position) = inputs.iter().position(|&id| id == input) {
            values[position] = value;
        }
    };
    match trace {
        Trace::Scans(trace) => rows.extend(trace.scans.iter().map(|scan| {
            scan.inputs.iter().for_each(|&(input, value)| copy(&mut values, input, value));
            row(&values)
        })),
        Trace::Firings(trace) => {
            // The trace was replayed before, so this replay does not fail.
            let mut begun = false;
            for firing in firing_story(system, trace).unwrap_or_default() {
                if let Some((input, value)) = firing.copied {
                    copy(&mut values, input, value);
                    begun = true;
                } else if std::mem::take(&mut begun) {
                    rows.push(row(&values));
                }
            }
        }
    }
    table::write(rows)
}
