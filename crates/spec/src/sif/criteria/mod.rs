//! Test generation by criterion: the valuations of its inputs with which a function is tested.
//!
//! Data shared by all criteria is computed once per function ([`Study`]): the set of allowed valuations, as a decision
//! diagram if that stays small enough; the valuations themselves if they are few, or else a selection found by a solver
//! that shows every detectable fault; and the values of the inputs that do not matter. Each criterion then selects
//! tests.

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

/// Generates the tests of a function by one criterion. For several criteria, use a [`Study`].
#[must_use]
pub fn plan(specification: &Specification, function: usize, criterion: Criterion, limits: &Limits) -> Plan {
    Study::new(specification, function, limits).plan(criterion)
}

/// Mutation score of given tests of a function (sets of inputs that are TRUE).
#[must_use]
pub fn coverage_of(specification: &Specification, function: usize, tests: &[FixedBitSet], limits: &Limits) -> Coverage {
    Study::new(specification, function, limits).coverage(tests)
}
