//! Pictures of nets, and the positions of their nodes, by construction: no search for a layout, so the same net always looks
//! the same, and the time is linear in its size.
//!
//! Every picture is made of blocks: control places on the left, transitions in the middle, bits on the right, straight arcs
//! between neighbouring columns, so that no arc passes through a node. A read arc has a black circle for a head (seed
//! paper, figure 2). Where a place would be far from its transitions it is drawn again as a grey copy, a *logical place*
//! (seed paper, table 1).

mod block;
mod control;
mod crossings;
mod diagram;
mod picture;
mod positions;
mod subnet;
mod svg;

pub use diagram::{diagram, surroundings};
pub use picture::{Anchor, At, DrawnArc, DrawnPlace, DrawnText, DrawnTransition, Head, Picture, PlaceStyle};
pub use positions::positions;
pub use subnet::subnet;
pub use svg::{BOX_HEIGHT, RADIUS};
