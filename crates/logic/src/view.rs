//! Views: what counts as a state of a program.

use serde::{Deserialize, Serialize};

/// A choice of states and steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum View {
    /// The end of a scan; a step is one scan.
    Scan,
    /// A marking of the net; a step is one firing.
    Transition,
}
