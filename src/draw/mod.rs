//! The positions of the nodes of nets, by construction: no search for a layout, so the same net always looks the same, and the
//! time is linear in its size.

mod control;
mod escape;
mod positions;

pub use positions::{Point, Positions};

pub(crate) use escape::printable;
