//! Findings of the sanity checks, as data.

use super::super::formula::{Formula, SignalId};
use super::super::specification::Place;

/// Kind of finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Doubt {
    /// No equation and no reset condition mentions the input `signals[0]`.
    InputNotUsed,
    /// The input `signals[0]` has no effect on any output or reset.
    InputWithoutEffect,
    /// The interface of `function` lists `signals[0]`, but its formulas do not mention it.
    InputListed,
    /// The formulas of `function` mention these signals, but its interface does not list them.
    InputNotListed,
    /// The output `signals[0]` is constantly `value`.
    Constant,
    /// The `restrictions` contradict each other.
    Contradiction,
    /// The first of `restrictions` is implied by the others.
    Implied,
    /// The only one of `restrictions` concerns no function in its scope.
    Apart,
    /// The cause `formula` makes the output `signals[0]` TRUE in no allowed test.
    CauseRemoved,
    /// The literal `formula`, of the signal `signals[1]` in the equation of `signals[0]`, never decides an output.
    NeverDecides,
    /// The two outputs `signals` are always equal or, if `value` is FALSE, always opposite.
    Same,
    /// The latched output `signals[0]` is never reset.
    ResetNever,
    /// The question could not be decided.
    NotDecided,
}

/// Finding. The meaning of its fields depends on the [`Doubt`]; cores of restrictions are minimal.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Kind of finding.
    pub doubt: Doubt,
    /// Place to report.
    pub place: Place,
    /// Function concerned.
    pub function: Option<usize>,
    /// Signals concerned.
    pub signals: Vec<SignalId>,
    /// Formula concerned.
    pub formula: Option<Formula>,
    /// Value concerned.
    pub value: bool,
    /// Number of a literal among the occurrences of its signal in the equation, from 1, if there are several.
    pub nth: Option<usize>,
    /// Restrictions responsible, by position in the specification.
    pub restrictions: Vec<usize>,
    /// Valuation that shows the finding.
    pub example: Option<Example>,
    /// Question that could not be decided.
    pub question: Option<String>,
}

/// Values of some signals: inputs, and latched or delayed outputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Example {
    /// Signals with their values.
    pub values: Vec<(SignalId, bool)>,
    /// Whether the restrictions exclude this valuation, in which the finding would be false. Else it is allowed, and
    /// the finding is true in it.
    pub is_excluded: bool,
}

impl Finding {
    /// Creates a finding at a place.
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
