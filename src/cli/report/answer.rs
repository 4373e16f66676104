//! Report of one requirement: verdict, formula, and counterexample or witness.

use petril::logic::Tag;
use petril::semantics::VarId;
use petril::verdict::{Answer, Focus, Independence, Outcome, Report, Trace, Verdict, Why, Witness};
use petril::witness::{
    Columns, FiringTrace, Piece, ScanTrace, Shown, firing_table, line_by_line, piecewise_scan_table,
};

use super::Text;
use super::diagram::{ASCII, UNICODE, diagram};
use super::layout::{INDENT, indent, paragraph};
use super::summary::length;
use crate::cli::console::Colour;
use crate::cli::show;

impl Text<'_> {
    /// Full report of an answer.
    pub(super) fn answer(&self, answer: &Answer, report: &Report) -> String {
        let mut out = self.head(answer);
        if answer.recalled {
            out += &self.told("known from an earlier run");
        }
        if let Some(remark) = &answer.remark {
            out += &self.doubtful("mind", remark);
        }
        match &answer.outcome {
            Outcome::Unknown(reason) => out += &self.told(&format!("because {reason}")),
            Outcome::Holds { vacuous, witness, example } => {
                if let Some(vacuity) = vacuous {
                    out += &self.doubtful("vacuously", &vacuity.sentence());
                }
                if let Some(independence) = answer.independent {
                    out += &self.told(match independence {
                        Independence::OfEverything => "whatever the program does: it is true of everything",
                        Independence::OfTheProgram => "whatever the program does: it tests the plant, not the program",
                    });
                }
                match (witness, example) {
                    (Some(witness), _) if self.arguments.witnesses => {
                        out += &self.witness(answer, witness, None, report);
                    }
                    (None, Some(example)) if self.arguments.witnesses => {
                        out += &self.told("for example:");
                        out += &self.witness(answer, example, None, report);
                    }
                    (Some(witness), _) => {
                        out += &self.told(&format!("shown by a run of {} (--witnesses prints it)", length(witness)));
                    }
                    _ => {}
                }
            }
            Outcome::Violated(witness, why) => out += &self.witness(answer, witness, why.as_ref(), report),
        }
        out
    }

    /// Verdict, description and formula of the requirement.
    fn head(&self, answer: &Answer) -> String {
        let (word, colour) = match answer.outcome.verdict() {
            Verdict::Holds => ("HOLDS   ", Colour::Good),
            Verdict::Violated => ("VIOLATED", Colour::Bad),
            Verdict::Unknown => ("UNKNOWN ", Colour::Doubtful),
        };
        let mut title = answer.name.clone();
        if let Some(sentence) = &answer.sentence {
            title += &format!(": {sentence}");
        }
        if !answer.tags.is_empty() {
            let tags: Vec<String> = answer.tags.iter().map(tag).collect();
            title += &format!(" [{}]", tags.join(", "));
        }
        // Colour codes take no columns.
        let head = paragraph(word, word.len() + 1, &format!(" {title}"), self.console.output_width());
        let mut out = head.replacen(word, &self.console.paint(word, colour), 1);
        if let Some(words) = &answer.words {
            out += &self.told(words);
        }
        out + &self.told(&answer.formula)
    }

    /// Indented paragraph.
    fn told(&self, text: &str) -> String {
        paragraph(INDENT, INDENT.len(), text, self.console.output_width())
    }

    /// Indented paragraph starting with a word in the warning colour; the colour code takes no columns.
    fn doubtful(&self, word: &str, text: &str) -> String {
        self.told(&format!("{word}: {text}")).replacen(word, &self.console.paint(word, Colour::Doubtful), 1)
    }

    /// Width left beside the indent.
    fn width(&self) -> usize {
        self.console.output_width().saturating_sub(INDENT.len())
    }

    /// Trace as a table, its notes, and the explanation of the violation.
    fn witness(&self, answer: &Answer, witness: &Witness, why: Option<&Why>, report: &Report) -> String {
        let changes =
            why.and_then(|why| why.repair.as_ref()).map(|repair| repair.changes.as_slice()).unwrap_or_default();
        let matters = |scan: usize, id: VarId| changes.iter().any(|change| (change.scan, change.input) == (scan, id));
        let (columns, pieces) = self.shown(answer, witness);
        let mut out = String::from("\n");
        match &witness.trace {
            Trace::Scans(trace) => {
                let (columns, pieces) = (columns.clone(), pieces.clone());
                let shown = Shown { columns, pieces, is_marked: &matters, is_ascii: self.is_plain() };
                out += &indent(&piecewise_scan_table(self.system, trace, &shown).within(self.width()));
            }
            Trace::Firings(trace) => out += &indent(&firing_table(self.system, trace).within(self.width())),
        }
        out += "\n";
        // Notes on a single scan repeat the `wanted` sentences.
        let is_told = why.is_some_and(|why| !why.wanted.is_empty()) && !self.arguments.details;
        for note in witness.notes.iter().filter(|note| !is_told || note.first != note.last) {
            out += &self.told(&note.sentence(report.exploration.view));
        }
        out += &self.end(&witness.trace);
        out += &why.map(|why| self.why(why)).unwrap_or_default();
        let (details, by_line) = (self.arguments.details, self.arguments.by_line || self.arguments.details);
        if let Trace::Scans(trace) = &witness.trace {
            if details {
                let pen = if self.is_plain() { &ASCII } else { &UNICODE };
                let drawn = indent(&diagram(self.system, trace, (&columns, &pieces), self.width(), pen));
                if !drawn.is_empty() {
                    out += &format!("\n{drawn}");
                }
            }
            if by_line {
                let last = trace.scans.len() - 1;
                let lines = line_by_line(self.system, trace, last, self.source).within(self.width());
                out += &format!("\n{INDENT}scan {} line by line:\n\n{}", last + 1, indent(&lines));
            }
        }
        out
    }

    /// Shown variables and scans of a trace; uninteresting scans are folded.
    fn shown(&self, answer: &Answer, witness: &Witness) -> (Columns, Vec<Piece>) {
        let focus = Focus::of(answer, witness);
        let columns = match self.arguments.show.as_slice() {
            [] => focus.columns(self.system),
            patterns => show::columns(&self.system.program, patterns),
        };
        let pieces = match &witness.trace {
            Trace::Scans(trace) if self.arguments.every_scan => (0..trace.scans.len()).map(Piece::Scan).collect(),
            trace => focus.pieces(self.system, trace, &columns),
        };
        (columns, pieces)
    }

    /// Whether to draw with ASCII characters only; names are printed unchanged.
    fn is_plain(&self) -> bool {
        self.arguments.ascii || !self.console.has_unicode()
    }

    /// End of a trace: a runtime error or a loop.
    fn end(&self, trace: &Trace) -> String {
        match trace {
            Trace::Scans(ScanTrace { scans, loop_start: None }) => {
                let hazard = scans.last().and_then(|scan| scan.hazard);
                let place = hazard.map(|(line, _)| self.source.line_of(self.system.program.code[line].span.start));
                let text = |from| format!("{}:{from}: {}", self.source.name(), self.source.line_text(from).trim());
                place.map(|from| self.told(&text(from))).unwrap_or_default()
            }
            Trace::Scans(ScanTrace { scans, loop_start: Some(start) }) => {
                let (last, first) = (scans.len(), start + 1);
                self.told(&format!("and so on for ever: scan {last} ends in the state in which scan {first} ended"))
            }
            Trace::Firings(FiringTrace { firings, loop_start: Some(start) }) => {
                let last = firings.len();
                self.told(&format!("and so on for ever: firing {last} leads back to the marking after firing {start}"))
            }
            Trace::Firings(_) => String::new(),
        }
    }
}

/// Tag in its source form.
fn tag(tag: &Tag) -> String {
    match &tag.value {
        Some(value) => format!("{}: {value}", tag.name),
        None => tag.name.clone(),
    }
}
