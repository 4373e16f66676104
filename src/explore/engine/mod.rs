//! Explicit exploration of place/transition nets, built for speed and small memory.
//!
//! A [`Model`] is any place/transition net. Its place invariants tell how few bits a marking needs (`cover`, `packing`);
//! tables tell what a packed marking enables (`rows`, `candidates`), and firing is one addition. Firings that another order of the same
//! firings makes superfluous are left out (`swaps`). States are entered into a table whose entries hold only what their place in
//! it does not say (`lines`, `keys`), those of more than 64 bits after being folded (`fold`).

mod allowed;
mod candidates;
mod capacity;
mod conditions;
mod cover;
mod exploration;
mod fold;
mod graph;
mod index;
mod intern;
mod invariants;
mod keys;
mod lines;
mod machine;
mod model;
mod packing;
mod rows;
mod scramble;
mod search;
mod shard;
mod states;
mod swaps;
mod tally;
mod trace;
mod view;

pub(super) use capacity::explore_safely;
pub use exploration::{Exploration, Figures};
pub use graph::Steps;
pub use model::{Arcs, Model};
pub use search::{Options, explore};
pub use view::View;
