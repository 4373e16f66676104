//! Coverage section of the report: model size, remarks on the program, and variables without requirements.

use petril::semantics::VarId;
use petril::verdict::{Coverage, Remark, Report};

use super::Text;
use super::layout::joined;

impl Text<'_> {
    /// Model size and notes, grouped by kind.
    pub(super) fn coverage(&self, report: &Report) -> String {
        let mut out = match &report.coverage {
            Some(coverage) => self.line("modelled", &modelled(coverage)),
            None => String::new(),
        };
        for note in self.constant(report).into_iter().chain(self.dead(report)).chain(self.unasked(report)) {
            out += &self.line("note", &note);
        }
        out
    }

    /// Outputs that never change.
    fn constant(&self, report: &Report) -> Vec<String> {
        let program = &self.system.program;
        let text = |remark: &Remark| match *remark {
            Remark::NeverChanges(output, value) => {
                let value = program.value_text(output, value);
                Some(format!("`{}` is {value} at the end of every scan", program.variable(output).name))
            }
            Remark::NeverExecuted(_) => None,
        };
        report.remarks.iter().filter_map(text).collect()
    }

    /// Source lines that are never executed, each once.
    fn dead(&self, report: &Report) -> Vec<String> {
        let mut last = 0;
        let text = |remark: &Remark| match *remark {
            Remark::NeverChanges(..) => None,
            Remark::NeverExecuted(line) => {
                let from = self.source.line_of(self.system.program.code[line].span.start);
                let is_new = std::mem::replace(&mut last, from) != from;
                let (name, text) = (self.source.name(), self.source.line_text(from).trim());
                is_new.then(|| format!("this is never executed: {name}:{from}: {text}"))
            }
        };
        report.remarks.iter().filter_map(text).collect()
    }

    /// Variables that are never read or written (with `--details`), and those without a requirement (with `--details`
    /// or `--require`).
    fn unasked(&self, report: &Report) -> Vec<String> {
        let Some(coverage) = &report.coverage else { return Vec::new() };
        let mut notes = Vec::new();
        let mut add = |ids: &[VarId], what: &str| {
            if !ids.is_empty() {
                notes.push(format!("{what} {}", self.names(ids)));
            }
        };
        if self.arguments.details {
            add(&coverage.never_read, "no instruction reads");
            add(&coverage.never_written, "no instruction writes");
        }
        if self.arguments.details || !self.arguments.require.is_empty() {
            add(&coverage.unasked, "no requirement speaks of");
        }
        notes
    }

    fn names(&self, ids: &[VarId]) -> String {
        let names: Vec<String> = ids.iter().map(|&id| format!("`{}`", self.system.program.variable(id).name)).collect();
        joined(&names, "or")
    }
}

fn modelled(coverage: &Coverage) -> String {
    let lines = coverage.lines;
    match &coverage.never_executed {
        None => format!("all {lines} lines of flat code"),
        Some(never) if never.is_empty() => {
            format!("all {lines} lines of flat code, each of them executed in some scan")
        }
        Some(never) => format!("all {lines} lines of flat code, {} of them executed in some scan", lines - never.len()),
    }
}
