//! Nets from and to the formats of other tools, properties of nets, and reports for programs; one module for each format.
//!
//! Readers take a text and give a [`Located`](petril_net::net::Located) net, or what it says of nets, or everything that is wrong
//! with the text; writers give a text. What a safe place/transition net cannot express is refused, never left out in silence.

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
