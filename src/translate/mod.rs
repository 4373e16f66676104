//! Flat code and plant to one system net (seed paper, sections 3 and 4).
//!
//! A bit is two complementary places, `x=0` and `x=1`; the current result is one more bit, `CR`. Control is one token that
//! walks `idle`, the copying of the inputs, `line_1` … `line_n`, `End`, and back to `idle`. Every instruction is a small
//! subnet between the control places of its line and the next; one file here for each family of instructions.

mod combine;
mod complement;
mod domain;
mod jump;
mod load;
mod provenance;
mod set_reset;
mod store;
mod system;
mod valuation;
mod weaver;

pub mod plant;

pub use domain::{Domain, Domains};
pub use plant::Plant;
pub use provenance::{Part, PlaceRole, TransitionRole};
pub use system::System;
