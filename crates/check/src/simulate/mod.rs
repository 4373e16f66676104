//! Simulation: runs that are steered or random, scan by scan, or within a scan line by line and firing by firing, back
//! as well as forward.
//!
//! Whole scans are executed by the interpreter. Within a scan, the token game and the interpreter run side by side, as
//! in [`crate::witness::Replay`].

mod breakpoint;
mod chance;
mod lots;
mod plan;
mod session;
mod stopped;
mod walk;
mod watch;
mod within;

pub use breakpoint::{Breakpoint, condition};
pub use chance::Chance;
pub use lots::Lots;
pub use plan::{Impossible, Plan, scan};
pub use session::Session;
pub use stopped::Stopped;
pub use watch::Watch;
