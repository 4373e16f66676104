//! Foundation of all crates: texts with positions, diagnostics as data, XML, ids, and the elementary data types.

pub mod diagnostic;
mod ids;
pub mod printable;
mod rows;
pub mod source;
mod types;
pub mod xml;

pub use ids::{PlaceId, TransitionId, VarId};
pub use rows::Rows;
pub use types::{Kind, Type};
