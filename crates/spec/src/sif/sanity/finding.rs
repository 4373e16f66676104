//! What was found, as data.

use super::super::formula::{Formula, SignalId};
use super::super::specification::Place;

/// What is doubtful.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Doubt {
    /// No equation and no reset names the input `signals[0]`.
    InputNotUsed,
    /// Whatever the input `signals[0]` is, it makes no difference to any output or reset.
    InputWithoutEffect,
    /// The interface of `function` lists `signals[0]`, and its formulas do not name it.
    InputListed,
    /// The formulas of `function` name these signals, and its interface does not list them.
    InputNotListed,
    /// The output `signals[0]` always has `value`.
    Constant,
    /// No valuation keeps all of `restrictions`.
    Contradiction,
    /// The first of `restrictions` excludes nothing that the others do not.
    Implied,
    /// The only one of `restrictions` has nothing to do with any function that it is about.
    Apart,
    /// In no test does the cause `formula` make the output `signals[0]` TRUE.
    CauseRemoved,
    /// The literal `formula`, of the signal `signals[1]` in the equation of `signals[0]`, never decides an output.
    NeverDecides,
    /// The outputs `signals` are always the same, or, if `value` is FALSE, never.
    Same,
    /// The output `signals[0]` is never reset.
    ResetNever,
    /// The question could not be answered.
    NotDecided,
}

/// Something doubtful. What the fields mean for it, [`Doubt`] says; cores of restrictions are such that none can be left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What it is.
    pub doubt: Doubt,
    /// Where the reader is sent.
    pub place: Place,
    /// The function concerned.
    pub function: Option<usize>,
    /// The signals concerned.
    pub signals: Vec<SignalId>,
    /// The formula concerned.
    pub formula: Option<Formula>,
    /// The value concerned.
    pub value: bool,
    /// Which of the occurrences of its signal in its equation a literal is, from 1, if there are several.
    pub nth: Option<usize>,
    /// The restrictions that make it so: positions among those of the specification.
    pub restrictions: Vec<usize>,
    /// A valuation that shows it.
    pub example: Option<Example>,
    /// What could not be decided.
    pub question: Option<String>,
}

/// Values of some signals: inputs, and, if they are remembered, outputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Example {
    /// The signals and their values.
    pub values: Vec<(SignalId, bool)>,
    /// The restrictions exclude it, and without them it would be otherwise. Else it is allowed, and shows that it is so.
    pub is_excluded: bool,
}

impl Finding {
    /// A finding at a place.
    pub(super) fn new(doubt: Doubt, place: Place) -> Self {
        Self {
            doubt,
            place,
            function: None,
            signals: Vec::new(),
            formula: None,
            value: false,
            nth: None,
            restrictions: Vec::new(),
            example: None,
            question: None,
        }
    }

    pub(super) fn open(place: Place, question: impl Into<String>) -> Self {
        Self { question: Some(question.into()), ..Self::new(Doubt::NotDecided, place) }
    }

    pub(super) fn of(self, function: usize) -> Self {
        Self { function: Some(function), ..self }
    }

    pub(super) fn signals(self, signals: impl IntoIterator<Item = SignalId>) -> Self {
        Self { signals: signals.into_iter().collect(), ..self }
    }

    pub(super) fn formula(self, formula: Formula) -> Self {
        Self { formula: Some(formula), ..self }
    }

    pub(super) fn because(self, restrictions: Vec<usize>, example: Option<Example>) -> Self {
        Self { restrictions, example, ..self }
    }
}
