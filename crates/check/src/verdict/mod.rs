//! Verdicts: every requirement holds, is violated with a witness, or is undecided for a reason.

mod admitted;
mod answer;
mod asserted;
mod assumptions;
mod check;
mod coverage;
mod every_line;
mod failing;
mod fairness;
mod focus;
mod hazards;
mod independence;
mod judge;
mod known;

mod news;
mod on_paths;
mod options;
mod possible;
mod premises;
mod refused;
mod remarks;
mod remembering;
mod scan_ends;
mod views;
mod why;

pub use answer::{Answer, Change, Repair, Why, Writer};
pub use check::{check, check_aloud};
pub use coverage::Coverage;
pub use focus::Focus;
pub use independence::Independence;
pub use known::{Known, check_knowing, check_knowing_aloud, fingerprint};
pub use news::{News, Tell};
pub use options::Options;
pub use remarks::Remark;

use serde::{Deserialize, Serialize};

use crate::witness::{FiringTrace, ScanTrace};
use petril_logic::View;
use petril_search::Stop;

/// Result of checking a requirement.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Outcome {
    /// The requirement holds.
    Holds {
        /// Premise that never occurs: the requirement holds vacuously.
        vacuous: Option<Vacuity>,
        /// For an existential requirement, a run that shows it.
        witness: Option<Witness>,
        /// In the scan view, a run in which the premise occurs.
        example: Option<Witness>,
    },
    /// The requirement is violated, with a counterexample and, in the scan view, a diagnosis.
    Violated(Witness, Option<Why>),
    /// Undecided, with the reason.
    Unknown(String),
}

/// Vacuity: a premise that never occurs, as text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Vacuity {
    /// The premise is true in no reachable state.
    Nowhere(String),
    /// The premise is true in some states, but never where the requirement uses it: `b` in `AG (a -> AX (b -> c))`
    /// after `a`.
    NotThere(String),
}

impl Vacuity {
    /// The premise.
    #[must_use]
    pub fn premise(&self) -> &str {
        let (Self::Nowhere(premise) | Self::NotThere(premise)) = self;
        premise
    }

    /// The finding as a sentence.
    #[must_use]
    pub fn sentence(&self) -> String {
        match self {
            Self::Nowhere(premise) => format!("`{premise}` is true in no reachable state"),
            Self::NotThere(premise) => format!("`{premise}` is never true where the requirement asks for it"),
        }
    }
}

/// Verdict: one of three, ordered from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Proved.
    Holds,
    /// Undecided.
    Unknown,
    /// Refuted.
    Violated,
}

impl Verdict {
    /// The verdict in one word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Unknown => "unknown",
            Self::Violated => "violated",
        }
    }
}

impl Outcome {
    /// Unknown, because replay and search disagree: an error in Petril.
    #[must_use]
    pub fn refuted(what: &str) -> Self {
        Self::Unknown(format!("the replay refutes the search, which is an error in Petril; please report it: {what}"))
    }

    /// "Holds" without evidence.
    #[must_use]
    pub fn holds() -> Self {
        Self::Holds { vacuous: None, witness: None, example: None }
    }

    /// Verdict without evidence.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self {
            Self::Holds { .. } => Verdict::Holds,
            Self::Violated(..) => Verdict::Violated,
            Self::Unknown(_) => Verdict::Unknown,
        }
    }

    /// Counterexample, or run that shows an existential requirement.
    #[must_use]
    pub fn witness(&self) -> Option<&Witness> {
        match self {
            Self::Holds { witness, .. } => witness.as_ref(),
            Self::Violated(witness, _) => Some(witness),
            Self::Unknown(_) => None,
        }
    }
}

/// Witness: a run as evidence, replayed on the net and in the interpreter.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Witness {
    /// The run.
    pub trace: Trace,
    /// Facts shown by the run, with their positions.
    pub notes: Vec<Note>,
}

/// A run in one of the two views.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Trace {
    /// Scan by scan.
    Scans(ScanTrace),
    /// Firing by firing.
    Firings(FiringTrace),
}

/// Fact that is true on a part of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Note {
    /// First state of that part, from 0.
    pub first: usize,
    /// Last state of that part, from 0.
    pub last: usize,
    /// Fact as text.
    pub text: String,
}

impl Note {
    /// The note as a sentence: "after scan 2: …".
    #[must_use]
    pub fn sentence(&self, view: View) -> String {
        // States of the scan view are ends of scans; the initial marking precedes every firing.
        let (unit, first, last) = match view {
            View::Scan => ("scan", self.first + 1, self.last + 1),
            View::Transition => ("firing", self.first, self.last),
        };
        match (first, last) {
            (0, 0) => format!("at the beginning: {}", self.text),
            _ if first == last => format!("after {unit} {first}: {}", self.text),
            _ => format!("after {unit}s {first} to {last}: {}", self.text),
        }
    }
}

/// Figures of an exploration.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Exploration {
    /// State space: one state per scan, or one per marking.
    pub view: View,
    /// Number of states.
    pub states: usize,
    /// Number of steps (edges), counted for each state.
    pub steps: u64,
    /// Depth: largest distance of a state, in scans from power-on (scan view) or in firings from the initial marking
    /// (transition view).
    pub depth: usize,
    /// Whether all reachable states and steps were found.
    pub complete: bool,
    /// Reason why the search ended.
    pub stop: Stop,
    /// Size of the graph in bytes.
    pub bytes: u64,
    /// Whether the figures were taken from the cache of an earlier check.
    pub recalled: bool,
}

/// The result of a check.
#[derive(Clone, Debug)]
pub struct Report {
    /// Figures of the exploration.
    pub exploration: Exploration,
    /// Assumptions that the verdicts rest on.
    pub assumptions: Vec<String>,
    /// Warnings about the program, its plants and its requirements from before the check: code, place and message.
    pub warnings: Vec<String>,
    /// Answers to the requirements, in the given order.
    pub answers: Vec<Answer>,
    /// Answers of the built-in checks.
    pub checks: Vec<Answer>,
    /// Further findings (scan view only).
    pub remarks: Vec<Remark>,
    /// Coverage of the program (scan view only).
    pub coverage: Option<Coverage>,
}

impl Report {
    /// Overall verdict: violated if one answer is, else unknown if one is, else holds.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let answers = self.answers.iter().chain(&self.checks);
        answers.map(|answer| answer.outcome.verdict()).max().unwrap_or(Verdict::Holds)
    }
}
