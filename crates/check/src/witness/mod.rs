//! Traces: reconstructed from search results, replayed by code independent of the search, and presented in the terms of
//! the program.
//!
//! The replay plays the token game of [`petril_net::net`] firing by firing and runs the interpreter in step with it; net and
//! interpreter must agree on every bit after every instruction, and with the claims of the search.

mod columns;
mod failed;
mod firing_trace;
mod fold;
mod narrate;
mod recalled;
mod replay;
mod scan_trace;
mod story;
mod table;
mod writes;

pub use columns::Columns;
pub use failed::{Failed, failed};
pub use firing_trace::{FiringTrace, firing_trace, replay_firings};
pub use fold::{Fold, Moved, Piece, fold};
pub use narrate::{Shown, firing_table, line_by_line, piecewise_scan_table, scan_table};
pub use recalled::Recalled;
pub use replay::{Disagreement, Replay};
pub use scan_trace::{Holds, PlantMove, Scan, ScanTrace, replay_lines, replay_scans, scan_trace, scan_trace_to};
pub use story::{Executed, ToldFiring, ToldScan, firing_story, story};
pub use table::{Column, Table};
pub use writes::{Write, last_writes};
