#![doc = include_str!("../README.md")]

pub mod diagnostic;
mod ids;
mod key;
pub mod printable;
mod rows;
pub mod source;
mod to_text;
mod types;
#[cfg(feature = "xml")]
pub mod xml;

pub use ids::{PlaceId, TransitionId, VarId};
pub use key::key;
pub use rows::Rows;
pub use to_text::to_text;
pub use types::{Kind, Type};
