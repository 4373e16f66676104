//! End of a report: requirements by verdict, and the built-in checks.

use petril::verdict::{Answer, Report, Trace, Verdict, Witness};
use petril::witness::{Column, Table};

use super::layout::{counted, indent};
use crate::cli::console::Console;

/// Count of requirements above which a report ends with a table.
const MANY: usize = 12;

/// Table of the requirements if they are many and some do not hold.
pub fn table(report: &Report, console: &Console) -> String {
    let fine = report.answers.iter().all(|answer| answer.outcome.verdict() == Verdict::Holds);
    if report.answers.len() <= MANY || fine {
        return String::new();
    }
    let heads = [vec![Column::left("requirement")], vec![Column::left("verdict"), Column::left("shown by")]];
    let mut table = Table::new(heads.into());
    for answer in &report.answers {
        table.row(&[answer.name.clone(), answer.outcome.verdict().word().to_owned(), shown_by(answer)]);
    }
    format!("{}\n", indent(&table.within(console.output_width().saturating_sub(4))))
}

/// Length of the counterexample.
fn shown_by(answer: &Answer) -> String {
    match answer.outcome.witness() {
        Some(witness) if answer.outcome.verdict() == Verdict::Violated => length(witness),
        _ => String::new(),
    }
}

/// Length of a trace, "3 scans".
pub fn length(witness: &Witness) -> String {
    match &witness.trace {
        Trace::Scans(trace) => counted(trace.scans.len(), "scan"),
        Trace::Firings(trace) => counted(trace.firings.len(), "firing"),
    }
}

/// Requirements by verdict.
pub fn summary(report: &Report) -> String {
    let count = |verdict| report.answers.iter().filter(|answer| answer.outcome.verdict() == verdict).count();
    let (holds, violated, unknown) = (count(Verdict::Holds), count(Verdict::Violated), count(Verdict::Unknown));
    match report.answers.len() {
        0 => "no requirements were given (-r FORMULA or --require FILE)\n".to_owned(),
        n => {
            let mut parts = vec![format!("{holds} hold")];
            parts.extend((violated > 0).then(|| format!("{violated} violated")));
            parts.extend((unknown > 0).then(|| format!("{unknown} unknown")));
            format!("{}: {}\n", counted(n, "requirement"), parts.join(", "))
        }
    }
}

/// Built-in checks by verdict, in one line.
pub fn checks(report: &Report) -> String {
    let named = |verdict| {
        let checks = report.checks.iter().filter(|check| check.outcome.verdict() == verdict);
        let names: Vec<&str> = checks.map(|check| check.name.as_str()).collect();
        let verb = match verdict {
            Verdict::Holds if names.len() == 1 => "holds",
            Verdict::Holds => "hold",
            Verdict::Violated if names.len() == 1 => "is violated",
            Verdict::Violated => "are violated",
            Verdict::Unknown if names.len() == 1 => "is unknown",
            Verdict::Unknown => "are unknown",
        };
        (!names.is_empty()).then(|| format!("{} {verb}", names.join(", ")))
    };
    let checked: Vec<String> =
        [Verdict::Violated, Verdict::Unknown, Verdict::Holds].into_iter().filter_map(named).collect();
    if checked.is_empty() { String::new() } else { format!("checked without asking: {}\n", checked.join("; ")) }
}
