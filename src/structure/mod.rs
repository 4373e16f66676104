//! What can be said of a net without exploring it: the theory of its structure.

mod incidence;
mod invariants;
mod kernel;
pub(crate) mod semiflows;
mod sparse;

pub use incidence::Incidence;
pub use invariants::{
    Invariants, PlaceInvariant, TransitionInvariant, place_basis, place_invariants, transition_basis,
    transition_invariants,
};
pub use kernel::Kernel;
pub use semiflows::Limits;
