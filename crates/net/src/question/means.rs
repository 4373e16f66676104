//! Techniques that answers rest on.

use std::fmt;

/// Technique that an answer rests on. Runs do not depend on it: they have been replayed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Means {
    /// Explicit state-space exploration.
    Exploration,
    /// Random walk.
    Walk,
    /// State equation: an exactly verified certificate that it has no solution.
    StateEquation,
    /// Search for one goal with stubborn-set reduction.
    StubbornSets,
    /// Stubborn-set search in a net structurally reduced for the goal.
    Reduction,
}

impl fmt::Display for Means {
    /// Name of the technique in the contest.
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
