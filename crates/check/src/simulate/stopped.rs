//! Reasons why a session cannot make a step.

use std::fmt;

use super::plan::Impossible;
use crate::scans::Failure;
use crate::witness::Disagreement;

/// Reason why a step was not made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// The run is at power-on.
    PowerOn,
    /// The action is possible only between two scans.
    UnderWay,
    /// The variable is not an input.
    NoInput,
    /// The input is driven by the plant.
    Driven,
    /// The value lies outside the input's domain.
    NoValue,
    /// The plant cannot make the move.
    Plant(Impossible),
    /// The scan fails, or the one before did: the continuation is not known.
    Failed(Failure),
    /// Net and interpreter disagree, which is an error in Petril.
    Disagreement(Disagreement),
}

impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PowerOn => f.write_str("there is nothing before power-on"),
            Self::UnderWay => f.write_str("a scan is under way: inputs are read when one begins"),
            Self::NoInput => f.write_str("this is no input: the program gives it its values"),
            Self::Driven => f.write_str("the plant gives this input its values"),
            Self::NoValue => f.write_str("this input cannot have this value"),
            Self::Plant(impossible) => impossible.fmt(f),
            Self::Failed(Failure::Scan(_)) => f.write_str("this scan never ends"),
            Self::Failed(Failure::Hazard(line, hazard)) => {
                write!(f, "{hazard} in line {} of the flat code: what a PLC does then is not known", line + 1)
            }
            Self::Failed(Failure::NotSafe(_)) => f.write_str("a place would get a second token"),
            Self::Disagreement(disagreement) => write!(f, "net and interpreter disagree: {disagreement}"),
        }
    }
}
