//! Summary table of a project, one row per program.

use std::path::Path;

use petril::verdict::{Answer, Verdict};
use petril::witness::{Column, Table};

use super::run::Judged;
use crate::cli::check::Done;
use crate::cli::console::Console;
use crate::cli::report::{counted, indent};
use crate::cli::shown;

/// Row of the summary table.
pub struct Line<'a> {
    name: &'a str,
    /// None if the check of the program failed.
    done: Option<&'a Done>,
    /// Nothing if the program could not be checked.
    verdict: Option<Verdict>,
}

impl<'a> Line<'a> {
    pub fn of(judged: &'a Judged) -> Self {
        Self { name: &judged.name, done: judged.done.as_ref().ok(), verdict: judged.verdict() }
    }

    fn answers(&self) -> &'a [Answer] {
        self.done.map(|done| done.report.answers.as_slice()).unwrap_or_default()
    }

    fn count(&self, verdict: Verdict) -> usize {
        count(self.answers(), verdict)
    }

    fn known(&self) -> usize {
        self.answers().iter().filter(|answer| answer.recalled).count()
    }

    /// Worst verdict of the built-in checks.
    fn checks(&self, done: &Done) -> &'static str {
        let verdicts = done.report.checks.iter().map(|check| check.outcome.verdict());
        match verdicts.max().unwrap_or(Verdict::Holds) {
            Verdict::Holds => "hold",
            verdict => verdict.word(),
        }
    }
}

fn count(answers: &[Answer], verdict: Verdict) -> usize {
    answers.iter().filter(|answer| answer.outcome.verdict() == verdict).count()
}

/// Summary table and the totals over all programs.
pub fn summary(path: &Path, lines: &[Line<'_>], console: &Console) -> String {
    let mut out = format!("project {}, {}\n\n", shown(path), counted(lines.len(), "program"));
    let mut table = Table::new(vec![
        vec![Column::left("program")],
        vec![Column::right("requirements"), Column::right("hold"), Column::right("violated"), Column::right("unknown")],
        vec![Column::left("checks"), Column::right("states"), Column::right("known")],
    ]);
    for line in lines {
        let number = |number: usize| number.to_string();
        let row = match line.done {
            Some(done) => vec![
                line.name.to_owned(),
                number(line.answers().len()),
                number(line.count(Verdict::Holds)),
                number(line.count(Verdict::Violated)),
                number(line.count(Verdict::Unknown)),
                line.checks(done).to_owned(),
                number(done.report.exploration.states),
                number(line.known()),
            ],
            None => {
                let mut row = vec![String::new(); 8];
                row[0] = line.name.to_owned();
                row[5] = line.verdict.map_or("error", Verdict::word).to_owned();
                row
            }
        };
        table.row(&row);
    }
    out += &indent(&table.within(console.output_width().saturating_sub(4)));
    out += &format!("\n{}{}", programs(lines), requirements(lines));
    out
}

/// Programs by verdict, `3 programs: 2 hold, 1 violated`.
fn programs(lines: &[Line<'_>]) -> String {
    let with = |verdict| lines.iter().filter(|line| line.verdict == Some(verdict)).count();
    let wrong = lines.iter().filter(|line| line.verdict.is_none()).count();
    let mut parts = vec![format!("{} hold", with(Verdict::Holds))];
    parts.extend((with(Verdict::Violated) > 0).then(|| format!("{} violated", with(Verdict::Violated))));
    parts.extend((with(Verdict::Unknown) > 0).then(|| format!("{} unknown", with(Verdict::Unknown))));
    parts.extend((wrong > 0).then(|| format!("{wrong} with errors")));
    format!("{}: {}\n", counted(lines.len(), "program"), parts.join(", "))
}

fn requirements(lines: &[Line<'_>]) -> String {
    let sum = |of: &dyn Fn(&Line<'_>) -> usize| lines.iter().map(of).sum::<usize>();
    let of = |verdict| sum(&|line| line.count(verdict));
    let mut parts = vec![format!("{} hold", of(Verdict::Holds))];
    parts.extend((of(Verdict::Violated) > 0).then(|| format!("{} violated", of(Verdict::Violated))));
    parts.extend((of(Verdict::Unknown) > 0).then(|| format!("{} unknown", of(Verdict::Unknown))));
    let known = sum(&|line| line.known());
    let known = if known > 0 { format!(" ({known} known from an earlier run)") } else { String::new() };
    format!("{}: {}{known}\n", counted(sum(&|line| line.answers().len()), "requirement"), parts.join(", "))
}
