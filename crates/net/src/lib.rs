#![doc = include_str!("../README.md")]

pub mod engine;
#[cfg(feature = "formats")]
pub mod format;
mod goal;
mod markings;
mod names;
pub mod net;
pub mod question;
pub mod structure;
mod walk;

pub use goal::{Goal, Tokens};
pub use markings::{MarkingValuation, Markings, SECOND_TOKEN};
pub use walk::{Walk, without_loops};
