//! The scan view: the states at the ends of scans, the inputs a scan may begin with, and what is seen on the way through one.

mod admission;
mod asserted;
mod coverage;
mod failure;
mod free_inputs;
mod given;
mod scan_lanes;
mod scan_space;

pub use admission::Admission;
pub use asserted::{Seen, first_at_lines};
pub use coverage::never_executed;
pub use failure::Failure;
pub use free_inputs::MAX_FAN_OUT;
pub use given::Position;
pub use scan_space::{ScanRun, ScanSpace, ScanState};
