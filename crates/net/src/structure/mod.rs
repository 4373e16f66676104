//! Structure theory: properties of a net that follow without exploring it.

mod class;
mod commoner;
mod connected;
mod flow;
mod incidence;
mod invariants;
mod kernel;
mod largest;
pub mod reduce;
mod rounding;
pub(crate) mod semiflows;
mod simplex;
mod siphons;
mod sparse;
pub mod state_equation;
mod summary;

pub use class::Class;
pub use commoner::{Commoner, commoner, starved};
pub use connected::Components;
pub use flow::Flow;
pub use incidence::Incidence;
pub use invariants::{
    Invariants, PlaceInvariant, TransitionInvariant, place_basis, place_invariants, transition_basis,
    transition_invariants,
};
pub use kernel::Kernel;
pub use largest::{largest_siphon, largest_trap};
pub use semiflows::Limits;
pub use siphons::{SiphonLimits, Siphons, minimal_siphons, minimal_traps};
pub use summary::Summary;
