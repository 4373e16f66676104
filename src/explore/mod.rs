//! Reachable states: an interface ([`StateSpace`]), a packed store, breadth-first search, and the reachability graph.
//!
//! A system has two graphs: that of its [`Markings`], in which every firing is a step (the transition view), explored
//! by the [`engine`]; and that of its [`ScanSpace`], in which a step is one scan (the scan view), explored by
//! [`explore`], which does not depend on programs.

mod asserted;
mod budget;
mod circuit;
mod components;
mod coverage;
pub mod engine;
mod free_inputs;
mod given;
mod goal;
mod graph;
mod layout;
mod markings;
mod pairs;
mod product;
mod scan_lanes;
mod scan_space;
mod search;
mod space;
mod store;
mod table;
mod tarjan;
mod walk;
mod watched;

pub use asserted::{Seen, first_at_lines};
pub use budget::{Budget, Progress, Stop};
pub use circuit::{Gate, Lanes, NoGates, ScanGates, Wire};
pub use components::{Components, components, components_until};
pub use coverage::never_executed;
pub use free_inputs::MAX_FAN_OUT;
pub use given::Position;
pub use goal::{Goal, Tokens};
pub use graph::Graph;
pub use markings::Markings;
pub use pairs::{Follower, Pairs, followed};
pub use product::{Observer, observed};
pub use scan_space::{ScanRun, ScanSpace, ScanState};
pub use search::explore;
pub use space::{Admission, Failure, StateSpace, Step, Successors};
pub use walk::{Walk, without_loops};
pub use watched::watched;
