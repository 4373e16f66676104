//! Text report of a check.

mod answer;
mod coverage;
mod diagram;
mod layout;
mod printed;
mod summary;
mod why;

pub use layout::{counted, indent, paragraph};
pub use printed::Printed;

use petril::explore::Stop;
use petril::logic::View;
use petril::source::Source;
use petril::translate::{Part, System};
use petril::verdict::{Answer, Report, Verdict};
use petril::witness::{Column, Table};

use super::args::Check;
use super::console::Console;
use summary::{checks, summary, table};

/// Context of the text report.
pub struct Text<'a> {
    pub system: &'a System,
    pub source: &'a Source,
    pub arguments: &'a Check,
    pub console: &'a Console,
}

impl Text<'_> {
    /// Opening of a report: model size, exploration and assumptions.
    pub fn opening(&self, report: &Report) -> String {
        let program = &self.system.program;
        let title =
            format!("program `{}` from {}, {} lines of flat code", program.name, self.source.name(), program.end());
        let mut out = paragraph("", 0, &title, self.console.output_width()) + "\n";
        out += &indent(&self.size().to_string());
        out += "\n";
        out + &self.exploration(report)
    }

    /// Next answer of a report in progress; `report` need not contain it yet.
    pub fn next(&self, answer: &Answer, report: &Report) -> String {
        format!("\n{}", self.answer(answer, report))
    }

    /// Rest of a report of which the first `told` answers are printed.
    pub fn closing(&self, report: &Report, told: usize) -> String {
        // Checks that hold are listed in one line; the others are reported like requirements.
        let failing = report.checks.iter().filter(|check| check.outcome.verdict() != Verdict::Holds);
        let rest = report.answers.iter().skip(told).chain(failing);
        let mut out: String = rest.map(|answer| self.next(answer, report)).collect();
        out += "\n";
        out += &table(report, self.console);
        out += &summary(report);
        out += &checks(report);
        out += &self.coverage(report);
        out += &self.hints(report);
        out
    }

    /// Answers that do not hold.
    pub fn failing(&self, report: &Report) -> String {
        let answers = report.answers.iter().chain(&report.checks);
        let failing = answers.filter(|answer| answer.outcome.verdict() != Verdict::Holds);
        failing.map(|answer| format!("\n{}", self.answer(answer, report))).collect()
    }

    /// Paragraph starting with a heading and a colon.
    fn line(&self, head: &str, text: &str) -> String {
        let first = format!("{head}: ");
        paragraph(&first, first.chars().count(), text, self.console.output_width())
    }

    fn size(&self) -> Table {
        let mut table =
            Table::new(vec![vec![Column::left("net")], vec![Column::right("places"), Column::right("transitions")]]);
        for part in Part::ALL {
            let (places, transitions) = self.system.size(part);
            table.row(&[part.name().to_owned(), places.to_string(), transitions.to_string()]);
        }
        let net = &self.system.net;
        table.row(&["total".to_owned(), net.places().len().to_string(), net.transitions().len().to_string()]);
        table
    }

    fn exploration(&self, report: &Report) -> String {
        let exploration = &report.exploration;
        let (states, steps, depth) = (exploration.states, exploration.steps, exploration.depth);
        let (view, figures) = match exploration.view {
            View::Scan => (
                "scan view",
                format!(
                    "{} at the end of a scan, {}, {} deep",
                    counted(states, "state"),
                    counted(steps as usize, "step"),
                    counted(depth, "scan")
                ),
            ),
            View::Transition => (
                "transition view",
                format!(
                    "{}, {}, {} deep",
                    counted(states, "reachable marking"),
                    counted(steps as usize, "firing"),
                    counted(depth, "firing")
                ),
            ),
        };
        let end = match (&exploration.stop, exploration.complete) {
            (Stop::Complete, false) => "every state was explored, but none behind a scan that goes wrong".to_owned(),
            (stop, _) => stop.to_string(),
        };
        let end = if exploration.recalled { format!("{end}, in an earlier run") } else { end };
        let assumptions = report.assumptions.iter().map(|assumption| self.line("assumed", assumption));
        self.line(view, &format!("{figures}; {end}")) + &assumptions.collect::<String>()
    }

    /// Hints at further options.
    fn hints(&self, report: &Report) -> String {
        let shown = report.answers.iter().chain(&report.checks);
        let (mut violated, mut examples) = (false, false);
        for answer in shown {
            match &answer.outcome {
                petril::verdict::Outcome::Violated(..) => violated = true,
                petril::verdict::Outcome::Holds { example: Some(_), .. } => examples = true,
                _ => {}
            }
        }
        let mut out = String::new();
        if violated && !self.arguments.details && report.exploration.view == View::Scan {
            out += &self.line("hint", "--details draws the runs, and tells their last scans line by line");
        }
        let is_chosen = !self.arguments.show.is_empty();
        if violated && !is_chosen && !self.system.program.internal.is_empty() && report.exploration.view == View::Scan {
            out += &self.line("hint", "--show all shows what is local to instances of function blocks, too");
        }
        if examples && self.arguments.details && !self.arguments.witnesses {
            out += &self.line("hint", "--witnesses prints runs that are examples of what holds");
        }
        out
    }
}
