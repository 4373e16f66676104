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
mod known;

mod news;
mod on_paths;
mod possible;
mod premises;
mod remarks;
mod remembering;
mod scan_ends;
mod views;
mod why;

pub use answer::{Answer, Change, Repair, Why, Writer};
pub use check::{Options, check, check_aloud};
pub use coverage::Coverage;
pub use focus::Focus;
pub use independence::Independence;
pub use known::{Known, check_knowing, check_knowing_aloud, fingerprint};
pub use news::{News, Tell};
pub use remarks::Remark;

use serde::{Deserialize, Serialize};

use crate::witness::{FiringTrace, ScanTrace};
use petril_logic::View;
use petril_search::Stop;

/// What is known about a requirement.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Outcome {
    /// It holds.
    Holds {
        /// The premise that never occurs, so that the requirement says nothing.
        vacuous: Option<Vacuity>,
        /// For a requirement that something is possible, a way there.
        witness: Option<Witness>,
        /// In the scan view, a run in which its premise occurs.
        example: Option<Witness>,
    },
    /// It does not hold, as a run shows; in the scan view also why.
    Violated(Witness, Option<Why>),
    /// Nothing is known, for this reason.
    Unknown(String),
}

/// A premise that never occurs, as text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Vacuity {
    /// It is true in no reachable state.
    Nowhere(String),
    /// It is true in some states, but never where the requirement asks for it: `b` in `AG (a -> AX (b -> c))` after `a`.
    NotThere(String),
}

impl Vacuity {
    /// The premise.
    #[must_use]
    pub fn premise(&self) -> &str {
        let (Self::Nowhere(premise) | Self::NotThere(premise)) = self;
        premise
    }

    /// What is so, in words.
    #[must_use]
    pub fn sentence(&self) -> String {
        match self {
            Self::Nowhere(premise) => format!("`{premise}` is true in no reachable state"),
            Self::NotThere(premise) => format!("`{premise}` is never true where the requirement asks for it"),
        }
    }
}

/// The three verdicts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// It holds.
    Holds,
    /// Nothing is known.
    Unknown,
    /// It does not hold.
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
    /// It holds, and there is nothing to show.
    #[must_use]
    pub fn holds() -> Self {
        Self::Holds { vacuous: None, witness: None, example: None }
    }

    /// The verdict without its reasons.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self {
            Self::Holds { .. } => Verdict::Holds,
            Self::Violated(..) => Verdict::Violated,
            Self::Unknown(_) => Verdict::Unknown,
        }
    }

    /// The run that goes with the verdict.
    #[must_use]
    pub fn witness(&self) -> Option<&Witness> {
        match self {
            Self::Holds { witness, .. } => witness.as_ref(),
            Self::Violated(witness, _) => Some(witness),
            Self::Unknown(_) => None,
        }
    }
}

/// A run that shows why, replayed on the net and in the interpreter.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Witness {
    /// The run.
    pub trace: Trace,
    /// What it shows, where.
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

/// Something that is so during a part of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Note {
    /// First state of the run concerned, from 0.
    pub first: usize,
    /// Last state of the run concerned, from 0.
    pub last: usize,
    /// What is so.
    pub text: String,
}

impl Note {
    /// The note as a sentence: "after scan 2: …".
    #[must_use]
    pub fn sentence(&self, view: View) -> String {
        // States of the scan view are the ends of scans; the first marking is there before any firing.
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

/// What was explored.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Exploration {
    /// What a state is.
    pub view: View,
    /// States found.
    pub states: usize,
    /// Steps found, counted for each state.
    pub steps: u64,
    /// The largest of the shortest distances: in the scan view in scans from power-on, in the transition view in firings
    /// from the initial marking.
    pub depth: usize,
    /// Whether all reachable states and steps were found.
    pub complete: bool,
    /// Why the search ended.
    pub stop: Stop,
    /// Bytes the graph takes.
    pub bytes: u64,
    /// Whether this was found by an earlier check.
    pub recalled: bool,
}

/// The result of a check.
#[derive(Clone, Debug)]
pub struct Report {
    /// What was explored.
    pub exploration: Exploration,
    /// Under which assumptions the verdicts are proofs.
    pub assumptions: Vec<String>,
    /// What was said of the program, its plants and its requirements before the check, and is no error: code, place and message.
    pub warnings: Vec<String>,
    /// The requirements in the order they were given.
    pub answers: Vec<Answer>,
    /// What is checked without asking.
    pub checks: Vec<Answer>,
    /// In the scan view, what else is worth knowing.
    pub remarks: Vec<Remark>,
    /// In the scan view, what of the program was modelled, executed, and asked about.
    pub coverage: Option<Coverage>,
}

impl Report {
    /// The verdict on everything: violated if one answer is, else unknown if one is, else holds.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let answers = self.answers.iter().chain(&self.checks);
        answers.map(|answer| answer.outcome.verdict()).max().unwrap_or(Verdict::Holds)
    }
}
