//! PNML, place/transition nets (ISO/IEC 15909-2).
//!
//! Supported are nets over several pages, with reference nodes, with or without graphics. Of tool sections, that of
//! nested-unit Petri nets (NUPN) is read; others are ignored. A node is called by its name, or by its id if it has no
//! name or shares it with an earlier node.

mod contents;
mod extras;
mod ids;
mod label;
mod read;
mod references;
mod units;
mod write;

#[cfg(test)]
mod tests;

pub use extras::{Note, Notes, Point, Positions};
pub use read::{read, read_safe};
pub use write::{Extras, write, write_to};
