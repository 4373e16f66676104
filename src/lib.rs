//! Petril proves PLC programs in IEC 61131-3 Instruction List right, or shows the exact scan in which they go wrong.
//!
//! A program is read and checked, flattened into numbered lines, and translated into a safe Petri net together with the
//! PLC's cycle and a model of the plant. All its reachable states are explored, and requirements in CTL are checked on them.
//!
//! ```
//! use petril::{Check, source::Source, verdict::Verdict};
//!
//! let starter = Source::new("starter.il", "
//!     PROGRAM starter
//!     VAR_INPUT  Start, Stop : BOOL; END_VAR
//!     VAR_OUTPUT Motor : BOOL; END_VAR
//!         LD   Start
//!         OR   Motor
//!         ANDN Stop
//!         ST   Motor
//!     END_PROGRAM");
//!
//! // No plant: Start and Stop may have any value in any scan.
//! let check = Check::of(&starter)?;
//! let holds = check.clone().require("stops", "AG (Stop -> !Motor)")?.run(&mut |_| None);
//! assert_eq!(holds.verdict(), Verdict::Holds);
//! let violated = check.require("waits", "AG (Motor -> Start)")?.run(&mut |_| None);
//! assert_eq!(violated.verdict(), Verdict::Violated);
//! # Ok::<(), Vec<petril::diagnostic::Diagnostic>>(())
//! ```
//!
//! `docs/architecture.md` says what the modules are for and in which order they stand; `docs/semantics.md` what exactly is
//! proved.

pub mod draw;
pub mod exchange;

pub use petril_base::{diagnostic, printable, source};
pub use petril_check::{Check, simulate, translate, witness};
pub use petril_lang::{flat, interpret, semantics, syntax};
pub use petril_net::{net, structure};
pub use petril_spec::sif;

/// State spaces of programs and nets: what explores them, the graph it leaves, and scans as gates.
pub mod explore {
    pub use petril_check::scans::*;
    pub use petril_lang::circuit::{Gate, Lanes, NoGates, ScanGates, Wire};
    pub use petril_net::{Goal, Markings, SECOND_TOKEN, Tokens, Walk, engine, without_loops};
    pub use petril_search::*;
}

/// Requirements: formulas, what their names mean, and their truth on a graph.
pub mod logic {
    pub use petril_check::requirement::*;
    pub use petril_logic::*;
    pub use petril_net::MarkingValuation;
}

/// Verdicts about programs, and answers about nets alone.
pub mod verdict {
    pub use petril_check::verdict::*;
    pub use petril_net::question::*;
}
