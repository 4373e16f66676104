//! Nets from and to the formats of other tools, and properties of nets; one module for each format.
//!
//! Readers take a text and give a [`Located`](crate::net::Located) net, or what it says of nets, or everything that is wrong
//! with the text; writers give a text. A construct that a place/transition net cannot express is refused, never left out in
//! silence. Names that a format cannot have are escaped so that it can be undone ([`unescaped`]).

mod draft;
mod escape;

pub mod andl;
pub mod dot;
pub mod ina;
pub mod lola;
pub mod mcc;
pub mod pnml;
pub mod tapaal;
pub mod tina;

pub use escape::unescaped;
