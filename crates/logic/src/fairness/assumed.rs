//! Fairness assumptions, as written and bound.

use crate::bound::Bound;
use crate::formula::Formula;
use petril_base::source::Span;

/// A fairness assumption as written, not yet bound.
#[derive(Clone, Debug)]
pub struct FairnessText {
    /// Name, if there is one.
    pub name: Option<String>,
    /// Description by the author.
    pub sentence: Option<String>,
    /// Content of the assumption.
    pub recurrence: Recurrence,
    /// Content as written, on one line.
    pub text: String,
    /// Span of the content.
    pub span: Span,
}

/// Recurrence: what is to be true infinitely often.
#[derive(Clone, Debug)]
pub enum Recurrence {
    /// Weak fairness: `again and again p`.
    Weak(Formula),
    /// Strong fairness: `if again and again p then again and again q`.
    Strong {
        /// Premise p.
        premise: Formula,
        /// Goal q.
        goal: Formula,
    },
    /// `released(a, b)`: each of these inputs is FALSE infinitely often; `pressed(a, b)`: TRUE.
    Inputs {
        /// Value that the inputs have infinitely often.
        value: bool,
        /// Names of the inputs, with their spans.
        names: Vec<(String, Span)>,
    },
    /// `plant`: each transition of the plant is disabled infinitely often.
    Plant,
}

/// A bound fairness assumption: fair are the runs that satisfy all of its constraints, and those that end.
#[derive(Clone, Debug)]
pub struct FairnessAssumption {
    /// Text for reports, with the name and the author's description.
    pub words: String,
    /// Constraints on runs.
    pub constraints: Vec<Constraint>,
    /// Whether the assumption contains times, so that its meaning depends on the scan time.
    pub speaks_of_time: bool,
}

impl FairnessAssumption {
    /// State formulas of the constraints.
    pub fn formulas(&self) -> impl Iterator<Item = &Bound> {
        self.constraints.iter().flat_map(|constraint| constraint.premise.iter().chain([&constraint.goal]))
    }
}

/// A fairness constraint: the goal is true infinitely often, if the premise is. Both are state formulas.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// Premise of a strong constraint; `None` for a weak one.
    pub premise: Option<Bound>,
    /// Goal.
    pub goal: Bound,
    /// Text for reports.
    pub words: String,
}
