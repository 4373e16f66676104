//! Reachable states: a seam ([`StateSpace`]), a packed store, a breadth-first search, and the graph it leaves.
//!
//! Two spaces are made from a system: [`MarkingSpace`], where every firing is a step (the transition view), and
//! [`ScanSpace`], where a step is one scan (the scan view). The search knows nothing of either.

mod budget;
mod components;
mod coverage;
pub mod engine;
mod free_inputs;
mod goal;
mod graph;
mod layout;
mod marking_space;
mod scan_space;
mod search;
mod space;
mod store;
mod tarjan;
mod walk;

pub use budget::{Budget, Progress, Stop};
pub use components::{Components, components};
pub use coverage::never_executed;
pub use free_inputs::MAX_FAN_OUT;
pub use goal::{Goal, Tokens};
pub use graph::Graph;
pub use marking_space::MarkingSpace;
pub use scan_space::{ScanRun, ScanSpace, ScanState};
pub use search::explore;
pub use space::{Failure, StateSpace, Step};
pub use walk::{Walk, without_loops};
