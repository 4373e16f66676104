//! Nets in the formats of other tools, properties of nets, and reports for programs; one module per format.
//!
//! Readers turn a text into a [`Located`](crate::net::Located) net or into properties, or report everything that is
//! wrong with it; writers produce a text. Constructs that a safe place/transition net cannot express are rejected,
//! never silently dropped.

mod checked;
mod draft;
mod escape;
mod notes;
mod provenance;
mod stamp;
mod table;

pub mod andl;
pub mod dot;
pub mod html;
pub mod ina;
pub mod json;
pub mod junit;
pub mod lola;
pub mod mcc;
pub mod plcverif;
pub mod pnml;
pub mod proof;
pub mod recorded;
pub mod report_csv;
pub mod sarif;
pub mod sif;
pub mod tapaal;
pub mod tina;
pub mod vcd;

pub use checked::{Checked, Purpose, runs};
pub use escape::unescaped;
pub use notes::{Note, Notes};
pub use provenance::{COMMIT, Provenance, VERSION};
pub use stamp::Stamp;

/// Output of a writer as a string.
fn text(write: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>) -> String {
    let mut bytes = Vec::new();
    write(&mut bytes).expect("memory takes everything that is written to it");
    String::from_utf8_lossy(&bytes).into_owned()
}
