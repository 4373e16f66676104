//! Explicit-state exploration of place/transition nets, designed for speed and little memory.
//!
//! A [`Model`] is any place/transition net. Place invariants reduce the bits of a marking (`cover`, `packing`); tables
//! give the enabled transitions of a packed marking (`rows`, `candidates`), and firing is one addition. Firings that
//! are redundant because of commuting transitions are left out, as with sleep sets (`swaps`). States are stored in a
//! compact hash table (`lines`, `keys`), those of more than 64 bits after tree compression (`fold`). A search for a
//! [`Goal`](super::Goal) fires only stubborn sets (`stubborn`).

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
