//! A report together with its subject, and what its output formats have in common.

use super::Provenance;
use petril_base::printable;
use petril_base::source::Source;
use petril_check::translate::System;
use petril_check::verdict::{Answer, Change, Focus, Independence, Outcome, Report, Trace, Why, Witness};
use petril_check::witness::{Shown, firing_table, piecewise_scan_table};
use petril_lang::semantics::VarId;
use petril_logic::{Origin, View};

/// A report, the system it is about, and the text of its program.
#[derive(Clone, Copy, Debug)]
pub struct Checked<'a> {
    /// System that was checked.
    pub system: &'a System,
    /// Text of the program.
    pub source: &'a Source,
    /// Report of the check.
    pub report: &'a Report,
    /// Provenance of the report.
    pub provenance: &'a Provenance,
}

/// Purpose of a run in an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// The run violates the requirement.
    Counterexample,
    /// The run shows that something is possible.
    Witness,
    /// The premise of the requirement occurs in the run.
    Example,
}

impl Purpose {
    /// The purpose in one word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Counterexample => "counterexample",
            Self::Witness => "witness",
            Self::Example => "example",
        }
    }
}

impl<'a> Checked<'a> {
    /// Answers to the requirements, then those of built-in checks.
    pub fn answers(&self) -> impl Iterator<Item = &'a Answer> + use<'a> {
        self.report.answers.iter().chain(&self.report.checks)
    }

    /// View of the check: one state per scan, or one per marking.
    #[must_use]
    pub fn view(&self) -> View {
        self.report.exploration.view
    }

    /// Source line, from 1, of a line of flat code, from 0.
    #[must_use]
    pub fn source_line(&self, line: usize) -> usize {
        self.system.program.code.get(line).map_or(1, |code| self.source.line_of(code.span.start))
    }

    /// Instruction of a line of flat code, from 0.
    #[must_use]
    pub fn instruction(&self, line: usize) -> String {
        let program = &self.system.program;
        let text = program.code.get(line).map(|code| program.text(code.instruction)).unwrap_or_default();
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// Name of a variable.
    #[must_use]
    pub fn name(&self, variable: VarId) -> &'a str {
        &self.system.program.variable(variable).name
    }

    /// Reason for the verdict, on one line, if there is something to say.
    #[must_use]
    pub fn reason(&self, answer: &Answer) -> Option<String> {
        let reason = match &answer.outcome {
            Outcome::Unknown(reason) => Some(reason.clone()),
            Outcome::Holds { vacuous: Some(vacuity), .. } => Some(format!("vacuous: {}", vacuity.sentence())),
            Outcome::Holds { .. } => answer.independent.map(|what| independence(what).to_owned()),
            Outcome::Violated(witness, _) => Some(self.notes(witness).collect::<Vec<_>>().join("; ")),
        };
        // Doubts about the requirement itself are reported with every verdict.
        let parts: Vec<String> = reason.into_iter().chain(answer.remark.clone()).collect();
        (!parts.is_empty()).then(|| printable::line(&parts.join("; ")))
    }

    /// Facts shown by a run, as sentences.
    pub fn notes(&self, witness: &Witness) -> impl Iterator<Item = String> {
        let view = self.view();
        witness.notes.iter().map(move |note| printable::line(&note.sentence(view)))
    }

    /// Table of a run with the facts it shows, as plain text.
    #[must_use]
    pub fn told(&self, answer: &Answer, witness: &Witness) -> String {
        let mut text = match &witness.trace {
            Trace::Scans(trace) => {
                let focus = Focus::of(answer, witness);
                let columns = focus.columns(self.system);
                let pieces = focus.pieces(self.system, &witness.trace, &columns);
                let is_marked = &|_, _| false;
                let shown = Shown { columns, pieces, is_marked, is_ascii: false };
                piecewise_scan_table(self.system, trace, &shown).to_string()
            }
            Trace::Firings(trace) => firing_table(self.system, trace).to_string(),
        };
        text.push('\n');
        text.extend(self.notes(witness).map(|note| note + "\n"));
        let (repeats, unit, last) = match &witness.trace {
            Trace::Scans(trace) => (trace.loop_start.map(|start| start + 1), "scan", trace.scans.len()),
            Trace::Firings(trace) => (trace.loop_start, "firing", trace.firings.len()),
        };
        if let Some(first) = repeats {
            text += &format!("and so on for ever: {unit} {last} leads back to where {unit} {first} ended\n");
        }
        text
    }

    /// Diagnosis of a violation, as sentences.
    #[must_use]
    pub fn explained(&self, why: &Why) -> Vec<String> {
        let program = &self.system.program;
        let mut sentences = why.wanted.clone();
        sentences.extend(why.writers.iter().map(|writer| {
            let (name, value) = (self.name(writer.variable), program.value_text(writer.variable, writer.value));
            let line = self.source_line(writer.line);
            let text = self.source.line_text(line).trim();
            format!("{name} = {value} was written in scan {} by {}:{line}: {text}", writer.scan + 1, self.source.name())
        }));
        sentences.extend(why.unwritten.iter().map(|&id| format!("{} has its initial value", self.name(id))));
        if let Some(repair) = &why.repair {
            let others = repair.others.iter().map(|changes| format!(", nor with {}", self.changes(changes)));
            let others: String = others.collect();
            sentences.push(format!("with {} this run would not break it{others}", self.changes(&repair.changes)));
        }
        sentences.extend(why.unrepaired.iter().map(|reason| format!("no input is named that matters: {reason}")));
        sentences.iter().map(|sentence| printable::line(sentence)).collect()
    }

    /// Input changes in words: "S1 = 0 instead of 1 in scan 2".
    #[must_use]
    pub fn changes(&self, changes: &[Change]) -> String {
        let one = |change: &Change| {
            let value = |pattern| self.system.program.value_text(change.input, pattern);
            let (name, from, to) = (self.name(change.input), value(change.from), value(change.to));
            format!("{name} = {to} instead of {from} in scan {}", change.scan + 1)
        };
        changes.iter().map(one).collect::<Vec<_>>().join(", ")
    }

    /// Place of a requirement, unless it is a formula given on the command line.
    #[must_use]
    pub fn file_of(&self, answer: &'a Answer) -> Option<&'a Origin> {
        answer.origin.as_ref().filter(|origin| origin.file != format!("formula {}", answer.name))
    }
}

/// Independence of a requirement, in words.
#[must_use]
pub fn independence(what: Independence) -> &'static str {
    match what {
        Independence::OfEverything => "it is true whatever the program and the plant do",
        Independence::OfTheProgram => "it speaks of inputs alone, so it holds whatever the program does",
    }
}

/// Runs of an answer, each with its purpose.
pub fn runs(answer: &Answer) -> impl Iterator<Item = (Purpose, &Witness)> {
    let (violated, witness, example) = match &answer.outcome {
        Outcome::Violated(witness, _) => (Some(witness), None, None),
        Outcome::Holds { witness, example, .. } => (None, witness.as_ref(), example.as_ref()),
        Outcome::Unknown(_) => (None, None, None),
    };
    let purposes = [Purpose::Counterexample, Purpose::Witness, Purpose::Example];
    purposes.into_iter().zip([violated, witness, example]).filter_map(|(purpose, run)| Some((purpose, run?)))
}

/// Diagnosis of a violated answer.
#[must_use]
pub fn why(answer: &Answer) -> Option<&Why> {
    match &answer.outcome {
        Outcome::Violated(_, why) => why.as_ref(),
        _ => None,
    }
}

/// Tags of an answer, as written in a requirement file.
pub fn tags(answer: &Answer) -> impl Iterator<Item = String> {
    answer.tags.iter().map(|tag| match &tag.value {
        Some(value) => format!("{}: {value}", tag.name),
        None => tag.name.clone(),
    })
}
