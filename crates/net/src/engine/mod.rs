//! Explicit exploration of place/transition nets, built for speed and small memory.
//!
//! A [`Model`] is any place/transition net. Its place invariants tell how few bits a marking needs (`cover`, `packing`);
//! tables tell what a packed marking enables (`rows`, `candidates`), and firing is one addition. Firings that another order of the same
//! firings makes superfluous are left out (`swaps`). States are entered into a table whose entries hold only what their place in
//! it does not say (`lines`, `keys`), those of more than 64 bits after being folded (`fold`). A search for a [`Goal`](crate::Goal)
//! fires only what its stubborn sets hold (`stubborn`).

mod allowed;
mod behaviour;
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
mod numbering;
mod packing;
mod reader;
mod rows;
mod scramble;
mod search;
mod shard;
mod states;
mod stubborn;
mod swaps;
mod tally;
mod trace;
mod view;

pub use behaviour::Behaviour;
pub(crate) use capacity::explore_safely;
pub use exploration::{Exploration, Figures};
pub use graph::Steps;
pub use model::{Arcs, Model};
pub use reader::Reader;
pub use search::{Options, Wanted, explore, explore_towards};
pub use view::View;
