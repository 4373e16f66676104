//! Explanation of a violation in sentences.

use petril::verdict::{Change, Repair, Why};

use super::Text;
use super::layout::{INDENT, joined, paragraph};

impl Text<'_> {
    /// Expected values, writers of the actual values, and decisive inputs.
    pub(super) fn why(&self, why: &Why) -> String {
        let mut out = String::new();
        for sentence in &why.wanted {
            out += &self.reason("wanted", sentence);
        }
        let program = &self.system.program;
        for writer in &why.writers {
            let code = &program.code[writer.line];
            let name = &program.variable(writer.variable).name;
            let value = program.value_text(writer.variable, writer.value);
            let words = program.text(code.instruction);
            let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
            let (file, line) = (self.source.name(), self.source.line_of(code.span.start));
            let scan = writer.scan + 1;
            out += &self.reason("written", &format!("`{name}` = {value} in scan {scan} by `{words}`, {file}:{line}"));
        }
        for &variable in &why.unwritten {
            let variable = program.variable(variable);
            out += &self.reason("written", &format!("`{}` by nobody: it has its initial value", variable.name));
        }
        match (&why.repair, &why.unrepaired) {
            (Some(repair), _) => out += &self.reason("matters", &self.repair(repair)),
            (None, Some(reason)) => out += &self.reason("matters", reason),
            (None, None) => {}
        }
        out
    }

    fn reason(&self, head: &str, text: &str) -> String {
        let first = format!("{INDENT}{:<9}", format!("{head}:"));
        paragraph(&first, first.len(), text, self.console.output_width())
    }

    /// Decisive inputs and their alternatives.
    fn repair(&self, repair: &Repair) -> String {
        let mut text = format!("with {} (marked !) this run would not break it", self.changes(&repair.changes));
        if !repair.others.is_empty() {
            let others: Vec<String> = repair.others.iter().map(|changes| self.changes(changes)).collect();
            text += &format!(", nor with {}", joined(&others, "or"));
        }
        if !repair.is_smallest && repair.changes.len() > 1 {
            text += " (fewer inputs may do)";
        }
        text
    }

    /// Input changes by scan, "S1 = 0 and O1 = 1 in scan 2".
    fn changes(&self, changes: &[Change]) -> String {
        let program = &self.system.program;
        let mut scans: Vec<String> = Vec::new();
        for part in changes.chunk_by(|one, next| one.scan == next.scan) {
            let value = |change: &Change| {
                let value = program.value_text(change.input, change.to);
                format!("{} = {value}", program.variable(change.input).name)
            };
            let values: Vec<String> = part.iter().map(value).collect();
            scans.push(format!("{} in scan {}", joined(&values, "and"), part[0].scan + 1));
        }
        joined(&scans, "and")
    }
}
