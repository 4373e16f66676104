//! The report of a check as text for people.

use petril::explore::Stop;
use petril::logic::View;
use petril::source::Source;
use petril::translate::{Part, System};
use petril::verdict::{Answer, Outcome, Remark, Report, Trace, Verdict, Witness};
use petril::witness::{Column, FiringTrace, ScanTrace, Table, firing_table, line_by_line, scan_table};

use super::args::Check;
use super::console::{Colour, Console};

/// Everything the text depends on besides the report.
pub struct Text<'a> {
    pub system: &'a System,
    pub source: &'a Source,
    pub arguments: &'a Check,
    pub console: &'a Console,
}

impl Text<'_> {
    /// The whole report.
    pub fn report(&self, report: &Report) -> String {
        let program = &self.system.program;
        let mut out =
            format!("program `{}` from {}, {} lines of flat code\n\n", program.name, self.source.name(), program.end());
        out += &indent(&self.size().to_string());
        out += "\n";
        out += &self.exploration(report);
        for answer in &report.answers {
            out += "\n";
            out += &self.answer(answer, report);
        }
        // A check that holds is one word; the others are told like requirements.
        for check in report.checks.iter().filter(|check| check.outcome.verdict() != Verdict::Holds) {
            out += "\n";
            out += &self.answer(check, report);
        }
        out += "\n";
        out += &summary(report);
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
        if !checked.is_empty() {
            out += &format!("checked without asking: {}\n", checked.join("; "));
        }
        out += &self.remarks(report);
        out
    }

    /// One line for each remark, and for each line of source.
    fn remarks(&self, report: &Report) -> String {
        let program = &self.system.program;
        let mut last = 0;
        let text = |remark: &Remark| match *remark {
            Remark::NeverChanges(output, value) => {
                let value = program.value_text(output, value);
                let name = &program.variable(output).name;
                Some(format!("note: `{name}` is {value} at the end of every scan\n"))
            }
            Remark::NeverExecuted(line) => {
                let from = self.source.line_of(program.code[line].span.start);
                let is_new = std::mem::replace(&mut last, from) != from;
                let (name, text) = (self.source.name(), self.source.line_text(from).trim());
                is_new.then(|| format!("note: this is never executed: {name}:{from}: {text}\n"))
            }
        };
        report.remarks.iter().filter_map(text).collect()
    }

    fn size(&self) -> Table {
        let mut table =
            Table::new(vec![vec![Column::left("net")], vec![Column::right("places"), Column::right("transitions")]]);
        for part in Part::ALL {
            let (places, transitions) = self.system.size(part);
            table.row(vec![part.name().to_owned(), places.to_string(), transitions.to_string()]);
        }
        let net = &self.system.net;
        table.row(vec!["total".to_owned(), net.places().len().to_string(), net.transitions().len().to_string()]);
        table
    }

    fn exploration(&self, report: &Report) -> String {
        let exploration = &report.exploration;
        let (states, steps, depth) = (exploration.states, exploration.steps, exploration.depth);
        let mut out = match exploration.view {
            View::Scan => format!(
                "scan view: {} at the end of a scan, {}, {} deep",
                counted(states, "state"),
                counted(steps as usize, "step"),
                counted(depth, "scan")
            ),
            View::Transition => format!(
                "transition view: {}, {}, {} deep",
                counted(states, "reachable marking"),
                counted(steps as usize, "firing"),
                counted(depth, "firing")
            ),
        };
        out += &match (&exploration.stop, exploration.complete) {
            (Stop::Complete, false) => {
                "; every state was explored, but none behind a scan that goes wrong\n".to_owned()
            }
            (stop, _) => format!("; {stop}\n"),
        };
        for assumption in &report.assumptions {
            out += &format!("assumed: {assumption}\n");
        }
        out
    }

    fn answer(&self, answer: &Answer, report: &Report) -> String {
        let (word, colour) = match answer.outcome.verdict() {
            Verdict::Holds => ("HOLDS   ", Colour::Good),
            Verdict::Violated => ("VIOLATED", Colour::Bad),
            Verdict::Unknown => ("UNKNOWN ", Colour::Doubtful),
        };
        let mut out = format!("{} {}", self.console.paint(word, colour), answer.name);
        if let Some(sentence) = &answer.sentence {
            out += &format!(": {sentence}");
        }
        out += &format!("\n    {}\n", answer.formula);
        match &answer.outcome {
            Outcome::Unknown(reason) => out += &format!("    because {reason}\n"),
            Outcome::Holds { vacuous: Some(premise), .. } => {
                let doubt = self.console.paint("vacuously", Colour::Doubtful);
                out += &format!("    {doubt}: `{premise}` is true in no reachable state\n");
            }
            Outcome::Holds { witness: Some(witness), .. } if self.arguments.witnesses => {
                out += &self.witness(witness, report);
            }
            Outcome::Holds { witness: Some(Witness { trace, .. }), .. } => {
                let (length, unit) = match trace {
                    Trace::Scans(trace) => (trace.scans.len(), "scan"),
                    Trace::Firings(trace) => (trace.firings.len(), "firing"),
                };
                out += &format!("    shown by a run of {} (--witnesses prints it)\n", counted(length, unit));
            }
            Outcome::Holds { .. } => {}
            Outcome::Violated(witness, _) => out += &self.witness(witness, report),
        }
        out
    }

    fn witness(&self, witness: &Witness, report: &Report) -> String {
        let table = match &witness.trace {
            Trace::Scans(trace) => scan_table(self.system, trace),
            Trace::Firings(trace) => firing_table(self.system, trace),
        };
        let mut out = format!("\n{}\n", indent(&table.to_string()));
        for note in &witness.notes {
            out += &format!("    {}\n", note.sentence(report.exploration.view));
        }
        match &witness.trace {
            Trace::Scans(ScanTrace { scans, loop_start: None }) => {
                if let Some((line, _)) = scans.last().and_then(|scan| scan.hazard) {
                    let from = self.source.line_of(self.system.program.code[line].span.start);
                    out += &format!("    {}:{from}: {}\n", self.source.name(), self.source.line_text(from).trim());
                }
            }
            Trace::Scans(ScanTrace { scans, loop_start: Some(start) }) => {
                let (last, first) = (scans.len(), start + 1);
                out += &format!("    and so on for ever: scan {last} ends in the state in which scan {first} ended\n");
            }
            Trace::Firings(FiringTrace { firings, loop_start: Some(start) }) => {
                let last = firings.len();
                out +=
                    &format!("    and so on for ever: firing {last} leads back to the marking after firing {start}\n");
            }
            _ => {}
        }
        if let (Trace::Scans(trace), true) = (&witness.trace, self.arguments.by_line) {
            let last = trace.scans.len() - 1;
            let lines = line_by_line(self.system, trace, last, self.source);
            out += &format!("\n    scan {} line by line:\n\n{}", last + 1, indent(&lines.to_string()));
        }
        out
    }
}

fn summary(report: &Report) -> String {
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

/// A number of things: `1 scan`, `2 scans`.
pub fn counted(n: usize, thing: &str) -> String {
    if n == 1 { format!("1 {thing}") } else { format!("{n} {thing}s") }
}

/// Indents every line that is not empty.
fn indent(text: &str) -> String {
    text.lines().map(|line| if line.is_empty() { "\n".to_owned() } else { format!("    {line}\n") }).collect()
}
