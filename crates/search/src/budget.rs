//! Limits of a search, its progress, and the reason why it stopped.

use std::fmt;
use std::hint::black_box;

use serde::{Deserialize, Serialize};

/// Limits of a search. At the first limit the search stops and keeps its results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Maximum number of states kept.
    pub states: u64,
    /// Maximum memory for states, steps and index, in bytes.
    pub bytes: u64,
}

impl Default for Budget {
    /// Limits of 100 million states and 8 GiB.
    fn default() -> Self {
        Self { states: 100_000_000, bytes: 8 << 30 }
    }
}

/// Whether `bytes` bytes can be allocated at once. A failed allocation of a growing list would abort the program.
pub fn is_available(bytes: u64) -> bool {
    let mut probe: Vec<u8> = Vec::new();
    usize::try_from(bytes).is_ok_and(|bytes| black_box(&mut probe).try_reserve_exact(bytes).is_ok())
}

/// Figures of a search under way.
#[derive(Clone, Copy, Debug, Default)]
pub struct Progress {
    /// Number of states found.
    pub states: u64,
    /// Number of these states that are expanded: all their steps are known.
    pub expanded: u64,
    /// Distance of the states being expanded from an initial state, in steps.
    pub depth: usize,
    /// Memory in use, in bytes.
    pub bytes: u64,
}

/// Reason why a search ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Stop {
    /// The search is complete.
    Complete,
    /// The limit on the number of states was reached.
    States(u64),
    /// The limit on memory in bytes was reached.
    Bytes(u64),
    /// The state space is too large to search, for this reason.
    Refused(String),
    /// The caller's watcher stopped the search, for this reason.
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
