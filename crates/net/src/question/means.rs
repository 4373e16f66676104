//! How an answer was found.

use std::fmt;

/// What an answer rests on. Those with a run do not depend on it: the run has been replayed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Means {
    /// The states that were explored.
    Exploration,
    /// A walk that came upon a marking.
    Walk,
    /// A certificate that the state equation has no solution, verified exactly.
    StateEquation,
    /// A search for one goal that leaves out what stubborn sets allow to leave out.
    StubbornSets,
    /// The same, in a net reduced for the goal.
    Reduction,
}

impl fmt::Display for Means {
    /// As the contest names techniques.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Exploration => "EXPLICIT",
            Self::Walk => "RANDOM_WALK",
            Self::StateEquation => "STATE_EQUATION",
            Self::StubbornSets => "EXPLICIT STUBBORN_SETS",
            Self::Reduction => "EXPLICIT STUBBORN_SETS STRUCTURAL_REDUCTION",
        })
    }
}
