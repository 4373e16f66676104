//! What is told of a requirement.

use serde::{Deserialize, Serialize};

use super::{Independence, Outcome};
use crate::logic::{Origin, Requirement, Tag};
use petril_lang::semantics::VarId;

/// A requirement and its outcome.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Answer {
    /// Its name.
    pub name: String,
    /// What it says in the words of its author.
    pub sentence: Option<String>,
    /// What it says in the words of its pattern, if it is one.
    pub words: Option<String>,
    /// What else its author says of it.
    pub tags: Vec<Tag>,
    /// The formula, or the pattern, as it was written.
    pub formula: String,
    /// Where it stands; a check that is made without asking stands nowhere.
    pub origin: Option<Origin>,
    /// Variables of the program that the formula speaks of.
    #[serde(default)]
    pub variables: Vec<VarId>,
    /// What is known.
    pub outcome: Outcome,
    /// If it holds whatever the program does.
    pub independent: Option<Independence>,
    /// What is doubtful about the requirement itself, whatever the outcome is.
    pub remark: Option<String>,
    /// Whether this was found by an earlier check.
    pub recalled: bool,
}

impl Answer {
    /// The answer to a requirement.
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

    /// The outcome of a check that is made without asking.
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

/// Why a run breaks a requirement. Scans are positions in the run, from 0.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Why {
    /// What the requirement wanted where it is broken, and what there was instead, as sentences.
    pub wanted: Vec<String>,
    /// For each variable on which the break rests, and which the program computes, who wrote it last.
    pub writers: Vec<Writer>,
    /// Those of these variables that nobody has written by then: they have their initial values.
    pub unwritten: Vec<VarId>,
    /// Inputs that matter, if some were found.
    pub repair: Option<Repair>,
    /// If none were found, the reason.
    pub unrepaired: Option<String>,
}

/// The instruction that last wrote a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Writer {
    /// The variable.
    pub variable: VarId,
    /// The value it got, as a pattern of its type.
    pub value: u64,
    /// The scan in which it was written.
    pub scan: usize,
    /// The line of flat code, from 0.
    pub line: usize,
}

/// Inputs that matter: with other values of these, the run, made again, does not break the requirement; with other values of only
/// some of them it still does, or cannot be made.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Repair {
    /// The inputs, in the order of scans.
    pub changes: Vec<Change>,
    /// Whether it is known that there is none with fewer inputs.
    pub is_smallest: bool,
    /// Others of the same size, some of them: each of these sets would do, too.
    pub others: Vec<Vec<Change>>,
}

/// Another value of an input in one scan. Values are patterns of its type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Change {
    /// The scan.
    pub scan: usize,
    /// The input.
    pub input: VarId,
    /// What it was.
    pub from: u64,
    /// What it would have to be.
    pub to: u64,
}
