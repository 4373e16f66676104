//! Tests by criterion: which valuations of its inputs a function is to be tried with.
//!
//! What all criteria need is found once for a function ([`Study`]): the set of valuations that can be, as a decision diagram if that
//! stays small enough; all of them, if they are few, or else valuations that a solver found, which show every fault that can be
//! seen; and how the inputs are set that do not matter. Each criterion then chooses.

mod all;
mod allowed;
mod completion;
mod cover;
mod coverage;
mod excluded;
mod limits;
mod mcdc;
mod order;
mod pairing;
mod pairs;
mod pool;
mod sample;
mod study;

pub use all::about;
pub use excluded::excluded;
pub use limits::Limits;
pub use study::Study;

use fixedbitset::FixedBitSet;

use super::plan::{Coverage, Criterion, Plan};
use super::specification::Specification;

/// The tests of a function by one criterion. Whoever wants several asks a [`Study`].
#[must_use]
pub fn plan(specification: &Specification, function: usize, criterion: Criterion, limits: &Limits) -> Plan {
    Study::new(specification, function, limits).plan(criterion)
}

/// Which single faults of a function tests find that somebody else made: sets of the inputs that are TRUE.
#[must_use]
pub fn coverage_of(specification: &Specification, function: usize, tests: &[FixedBitSet], limits: &Limits) -> Coverage {
    Study::new(specification, function, limits).coverage(tests)
}
