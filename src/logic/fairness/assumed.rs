//! What is assumed of runs: as it is written, and bound.

use crate::logic::bound::Bound;
use crate::logic::formula::Formula;
use petril_base::source::Span;

/// A line about which runs count, before its names mean anything.
#[derive(Clone, Debug)]
pub struct FairnessText {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// What it says in the words of its author.
    pub sentence: Option<String>,
    /// What it says.
    pub recurrence: Recurrence,
    /// What it says as it was written, on one line.
    pub text: String,
    /// Where that stands.
    pub span: Span,
}

/// What comes again and again.
#[derive(Clone, Debug)]
pub enum Recurrence {
    /// `again and again p`
    Weak(Formula),
    /// `if again and again p then again and again q`
    Strong {
        /// p
        premise: Formula,
        /// q
        goal: Formula,
    },
    /// `released(a, b)`: each of these inputs is FALSE again and again; `pressed(a, b)`: TRUE.
    Inputs {
        /// What they are.
        value: bool,
        /// The inputs, with where they stand.
        names: Vec<(String, Span)>,
    },
    /// `plant`: each transition of the plant is unable to fire again and again.
    Plant,
}

/// A line about which runs count, bound: the runs that meet all of its constraints, and those that end.
#[derive(Clone, Debug)]
pub struct FairnessAssumption {
    /// What it says in words, with its name and those of its author.
    pub words: String,
    /// The constraints.
    pub constraints: Vec<Constraint>,
    /// Whether it speaks of times, so that what it means depends on how long a scan takes.
    pub speaks_of_time: bool,
}

impl FairnessAssumption {
    /// The formulas it speaks of, each about one state.
    pub fn formulas(&self) -> impl Iterator<Item = &Bound> {
        self.constraints.iter().flat_map(|constraint| constraint.premise.iter().chain([&constraint.goal]))
    }
}

/// Something comes again and again, perhaps only if something else does. Both are formulas about one state.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// If this comes again and again, or in any case,
    pub premise: Option<Bound>,
    /// so does this.
    pub goal: Bound,
    /// The same in words.
    pub words: String,
}
