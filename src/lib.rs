//! Petril proves PLC programs in IEC 61131-3 Instruction List right, or shows the exact scan in which they go wrong.
#![doc = ""]

pub mod diagnostic;
pub mod draw;
pub mod exchange;
pub mod explore;
pub mod flat;
pub mod interpret;
pub mod logic;
pub mod net;
pub mod semantics;
pub mod source;
pub mod syntax;
pub mod translate;
pub mod verdict;
pub mod witness;
