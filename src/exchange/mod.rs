//! Nets in the formats of other tools, properties of nets, and reports for programs; one module per format.
//!
//! Readers turn a text into a [`Located`](crate::net::Located) net or into properties, or report everything that is
//! wrong with it; writers produce a text. Constructs that a safe place/transition net cannot express are rejected,
//! never silently dropped.

mod checked;
mod notes;
mod provenance;
mod stamp;
mod table;

pub mod html;
pub mod json;
pub mod junit;
pub mod plcverif;
pub mod proof;
pub mod recorded;
pub mod report_csv;
pub mod sarif;
pub mod sif;
pub mod vcd;

pub use checked::{Checked, Purpose, runs};
pub use notes::notes;
pub use petril_net::format::{andl, dot, ina, lola, mcc, pnml, tapaal, tina, unescaped};
pub use provenance::{COMMIT, Provenance, VERSION};
pub use stamp::Stamp;
