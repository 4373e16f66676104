//! Answers: a requirement, assertion or check with its outcome, and why a run violates it.

use serde::{Deserialize, Serialize};

use super::{Independence, Outcome};
use petril_lang::semantics::VarId;
use petril_logic::{Origin, Requirement, Tag};

/// A requirement and its outcome.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Answer {
    /// Name of the requirement, assertion or check.
    pub name: String,
    /// Sentence given by the author in plain language.
    pub sentence: Option<String>,
    /// Reading of the pattern in words, if the formula is a pattern.
    pub words: Option<String>,
    /// Further properties given by the author (key and value).
    pub tags: Vec<Tag>,
    /// The formula, or the pattern, as it was written.
    pub formula: String,
    /// Place in the source or requirement file; `None` for a built-in check.
    pub origin: Option<Origin>,
    /// Variables of the program that the formula speaks of.
    #[serde(default)]
    pub variables: Vec<VarId>,
    /// Verdict with its evidence.
    pub outcome: Outcome,
    /// Reason why the requirement holds independently of the program, if so.
    pub independent: Option<Independence>,
    /// Warning about the requirement itself, independent of the outcome.
    pub remark: Option<String>,
    /// Whether the outcome was taken from the cache of an earlier check.
    pub recalled: bool,
}

impl Answer {
    /// Builds the answer to a requirement, with no remark and no independence yet.
    #[must_use]
    pub fn to(requirement: &Requirement, outcome: Outcome) -> Self {
        Self {
            name: requirement.name.clone(),
            sentence: requirement.sentence.clone(),
            words: requirement.words.clone(),
            tags: requirement.tags.clone(),
            formula: requirement.text.clone(),
            origin: Some(requirement.origin.clone()),
            variables: Vec::new(),
            outcome,
            independent: None,
            remark: None,
            recalled: false,
        }
    }

    /// Builds the answer of a built-in check.
    #[must_use]
    pub fn of_check(name: &str, sentence: &str, formula: &str, outcome: Outcome) -> Self {
        Self {
            name: name.to_owned(),
            sentence: Some(sentence.to_owned()),
            words: None,
            tags: Vec::new(),
            formula: formula.to_owned(),
            origin: None,
            variables: Vec::new(),
            outcome,
            independent: None,
            remark: None,
            recalled: false,
        }
    }
}

/// Diagnosis of a counterexample. Scans are positions in the run, counted from 0.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Why {
    /// Sentences: the expected value or behaviour where the requirement is violated, and the actual one.
    pub wanted: Vec<String>,
    /// Last writer of each computed variable that the violation depends on.
    pub writers: Vec<Writer>,
    /// Variables the violation depends on that no instruction has written yet: they have their initial values.
    pub unwritten: Vec<VarId>,
    /// Smallest input changes found that avoid the violation.
    pub repair: Option<Repair>,
    /// Reason why no such change was found.
    pub unrepaired: Option<String>,
}

/// Last write to a variable before the violation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Writer {
    /// Variable written.
    pub variable: VarId,
    /// Value written, as a bit pattern of the variable's type.
    pub value: u64,
    /// Scan of the write, from 0.
    pub scan: usize,
    /// Line of flat code, from 0.
    pub line: usize,
}

/// Minimal input changes that avoid the violation: the run repeated with these values satisfies the requirement; with
/// only some of them changed it is still violated, or cannot be repeated.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Repair {
    /// Changed inputs, in the order of scans.
    pub changes: Vec<Change>,
    /// Whether no smaller set of changes exists.
    pub is_smallest: bool,
    /// Alternatives of the same size (not necessarily all).
    pub others: Vec<Vec<Change>>,
}

/// Change of one input in one scan. Values are bit patterns of its type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Change {
    /// Scan, from 0.
    pub scan: usize,
    /// Input variable.
    pub input: VarId,
    /// Value in the original run.
    pub from: u64,
    /// Value that avoids the violation.
    pub to: u64,
}
