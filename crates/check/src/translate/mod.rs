//! Translation of flat code and plant to one system net (seed paper, sections 3 and 4).
//!
//! A bit is two complementary places: `x=0` and `x=1` of a `BOOL`, `x.3=0` and `x.3=1` of a wider type. The current
//! result `CR` has as many bits as the widest type of the program. Control is one token that moves through `idle`, the
//! copying of the inputs, `line_1` … `line_n`, `End`, and back to `idle`. Every instruction is a subnet between the
//! control places of its line and the next, with one file for each family of instructions. Instructions on more than
//! one bit go from bit to bit, through control places within the line that remember a carry or the like.

mod add;
mod bound;
mod combine;
mod compare;
mod complement;
mod convert;
mod copy;
mod divide;
mod domain;
mod element;
mod instruction;
mod jump;
mod load;
mod multiply;
mod provenance;
mod ranges;
mod register;
mod set_reset;
mod shift;
mod store;
mod subnet;
mod system;
mod units;
mod valuation;
mod walk;
mod weaver;
mod wire;

pub mod plant;

pub use domain::{Domain, Domains};
pub use plant::Plant;
pub use provenance::{Part, PlaceRole, Register, TransitionRole};
pub use system::System;
