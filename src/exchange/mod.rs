//! Nets from and to the formats of other tools, properties of nets, and reports for programs; one module for each format.
//!
//! Readers take a text and give a [`Located`](crate::net::Located) net, or what it says of nets, or everything that is wrong
//! with the text; writers give a text. What a safe place/transition net cannot express is refused, never left out in silence.

mod draft;
mod notes;

pub mod dot;
pub mod json;
pub mod mcc;
pub mod pnml;
pub mod tina;

pub use notes::{Note, Notes};
