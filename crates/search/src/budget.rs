//! How far a search may go, how far it is, and why it stopped.

use std::fmt;
use std::hint::black_box;

use serde::{Deserialize, Serialize};

/// What a search may use. It stops at the first limit and keeps what it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// States kept.
    pub states: u64,
    /// Bytes for states, steps and index.
    pub bytes: u64,
}

impl Default for Budget {
    /// A hundred million states, eight gibibytes.
    fn default() -> Self {
        Self { states: 100_000_000, bytes: 8 << 30 }
    }
}

/// Whether so many bytes can be had at once. A list that grows beyond what there is would end the program.
pub fn is_available(bytes: u64) -> bool {
    let mut probe: Vec<u8> = Vec::new();
    usize::try_from(bytes).is_ok_and(|bytes| black_box(&mut probe).try_reserve_exact(bytes).is_ok())
}

/// The figures of a search under way.
#[derive(Clone, Copy, Debug, Default)]
pub struct Progress {
    /// States found.
    pub states: u64,
    /// Of these, states whose steps are all known.
    pub expanded: u64,
    /// Length of a shortest way to the states being expanded, in steps from an initial state.
    pub depth: usize,
    /// Bytes in use.
    pub bytes: u64,
}

/// Why a search ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Stop {
    /// There is nothing left to find.
    Complete,
    /// The limit of states was reached.
    States(u64),
    /// The limit of memory was reached.
    Bytes(u64),
    /// The space is too large for any search, for this reason.
    Refused(String),
    /// Whoever watched the search stopped it, for this reason.
    Watcher(String),
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Complete => write!(f, "every state was explored"),
            Self::States(limit) => write!(f, "the limit of {limit} states was reached"),
            Self::Bytes(limit) => write!(f, "the limit of {} MiB was reached", limit >> 20),
            Self::Refused(reason) | Self::Watcher(reason) => write!(f, "{reason}"),
        }
    }
}
