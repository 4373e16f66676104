//! A report together with what it is about, and what its forms have in common.

use super::Provenance;
use crate::logic::{Origin, View};
use crate::translate::System;
use crate::verdict::{Answer, Change, Focus, Independence, Outcome, Report, Trace, Why, Witness};
use crate::witness::{Shown, firing_table, piecewise_scan_table};
use petril_base::printable;
use petril_base::source::Source;
use petril_lang::semantics::VarId;

/// A report, the system it is about, and the text of its program.
#[derive(Clone, Copy, Debug)]
pub struct Checked<'a> {
    /// The system that was checked.
    pub system: &'a System,
    /// The text of the program.
    pub source: &'a Source,
    /// What came out.
    pub report: &'a Report,
    /// Where it comes from.
    pub provenance: &'a Provenance,
}

/// What a run that goes with an answer is there for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// It breaks the requirement.
    Counterexample,
    /// It shows that something is possible.
    Witness,
    /// In it the premise of the requirement occurs.
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
    /// The requirements, then what was checked without asking.
    pub fn answers(&self) -> impl Iterator<Item = &'a Answer> + use<'a> {
        self.report.answers.iter().chain(&self.report.checks)
    }

    /// What a state is.
    #[must_use]
    pub fn view(&self) -> View {
        self.report.exploration.view
    }

    /// The line of source, from 1, that a line of flat code, from 0, comes from.
    #[must_use]
    pub fn source_line(&self, line: usize) -> usize {
        self.system.program.code.get(line).map_or(1, |code| self.source.line_of(code.span.start))
    }

    /// The instruction of a line of flat code, from 0.
    #[must_use]
    pub fn instruction(&self, line: usize) -> String {
        let program = &self.system.program;
        let text = program.code.get(line).map(|code| program.text(code.instruction)).unwrap_or_default();
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// A variable by its name.
    #[must_use]
    pub fn name(&self, variable: VarId) -> &'a str {
        &self.system.program.variable(variable).name
    }

    /// Why the verdict is what it is, on one line, if there is something to say.
    #[must_use]
    pub fn reason(&self, answer: &Answer) -> Option<String> {
        let reason = match &answer.outcome {
            Outcome::Unknown(reason) => Some(reason.clone()),
            Outcome::Holds { vacuous: Some(vacuity), .. } => Some(format!("vacuous: {}", vacuity.sentence())),
            Outcome::Holds { .. } => answer.independent.map(|what| independence(what).to_owned()),
            Outcome::Violated(witness, _) => Some(self.notes(witness).collect::<Vec<_>>().join("; ")),
        };
        // What is doubtful about the requirement goes with every verdict.
        let parts: Vec<String> = reason.into_iter().chain(answer.remark.clone()).collect();
        (!parts.is_empty()).then(|| printable::line(&parts.join("; ")))
    }

    /// What a run shows, as sentences.
    pub fn notes(&self, witness: &Witness) -> impl Iterator<Item = String> {
        let view = self.view();
        witness.notes.iter().map(move |note| printable::line(&note.sentence(view)))
    }

    /// A run that goes with an answer, as a table, and what it shows, in plain text.
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

    /// Why a run breaks a requirement, as sentences.
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

    /// Other values of inputs: "S1 = 0 instead of 1 in scan 2".
    #[must_use]
    pub fn changes(&self, changes: &[Change]) -> String {
        let one = |change: &Change| {
            let value = |pattern| self.system.program.value_text(change.input, pattern);
            let (name, from, to) = (self.name(change.input), value(change.from), value(change.to));
            format!("{name} = {to} instead of {from} in scan {}", change.scan + 1)
        };
        changes.iter().map(one).collect::<Vec<_>>().join(", ")
    }

    /// Where a requirement stands, if it stands in a file: a formula of the command line does not.
    #[must_use]
    pub fn file_of(&self, answer: &'a Answer) -> Option<&'a Origin> {
        answer.origin.as_ref().filter(|origin| origin.file != format!("formula {}", answer.name))
    }
}

/// What a requirement does not depend on, in words.
#[must_use]
pub fn independence(what: Independence) -> &'static str {
    match what {
        Independence::OfEverything => "it is true whatever the program and the plant do",
        Independence::OfTheProgram => "it speaks of inputs alone, so it holds whatever the program does",
    }
}

/// The runs that go with an answer, each with what it is there for.
pub fn runs(answer: &Answer) -> impl Iterator<Item = (Purpose, &Witness)> {
    let (violated, witness, example) = match &answer.outcome {
        Outcome::Violated(witness, _) => (Some(witness), None, None),
        Outcome::Holds { witness, example, .. } => (None, witness.as_ref(), example.as_ref()),
        Outcome::Unknown(_) => (None, None, None),
    };
    let purposes = [Purpose::Counterexample, Purpose::Witness, Purpose::Example];
    purposes.into_iter().zip([violated, witness, example]).filter_map(|(purpose, run)| Some((purpose, run?)))
}

/// The explanation of an answer.
#[must_use]
pub fn why(answer: &Answer) -> Option<&Why> {
    match &answer.outcome {
        Outcome::Violated(_, why) => why.as_ref(),
        _ => None,
    }
}

/// The tags of an answer, each as it is written in a requirement file.
pub fn tags(answer: &Answer) -> impl Iterator<Item = String> {
    answer.tags.iter().map(|tag| match &tag.value {
        Some(value) => format!("{}: {value}", tag.name),
        None => tag.name.clone(),
    })
}
