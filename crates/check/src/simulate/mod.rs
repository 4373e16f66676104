//! Runs that somebody steers, or chance: scan by scan, or within a scan line by line and firing by firing, back as well as
//! forward.
//!
//! Whole scans are executed by the interpreter. Whoever goes into a scan gets the token game and the interpreter side by
//! side, as [`crate::witness::Replay`] runs them.

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
