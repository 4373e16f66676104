//! Result of an exploration.

use std::sync::OnceLock;

use super::machine::Machine;
use super::numbering::Stretch;
use super::shard::Shard;
use petril_search::{Progress, Stop};

/// Figures of an exploration, or of the part explored if it was not completed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Figures {
    /// Number of states found.
    pub states: u64,
    /// Number of expanded states.
    pub expanded: u64,
    /// Number of pairs of an expanded state and a transition enabled in it.
    pub transitions: u64,
    /// Number of firings tried; the others were known to lead to no new state. Depends on the number of threads.
    pub fired: u64,
    /// Maximum number of tokens on one place of a state.
    pub max_tokens_in_place: u64,
    /// Maximum total number of tokens of a state.
    pub max_tokens_in_marking: u64,
    /// Maximum number of tokens of each place.
    pub place_maxima: Vec<u64>,
    /// Transitions that no expanded state enables.
    pub never_enabled: Vec<usize>,
    /// Number of deadlocks: expanded states that enable no transition.
    pub deadlocks: u64,
    /// A nearest deadlock; always the same one of several.
    pub deadlock: Option<Vec<u64>>,
    /// Maximum distance of an expanded state from the initial one, in firings.
    pub depth: usize,
    /// Number of bits of a packed marking.
    pub bits: u32,
    /// Memory in use at the end, in bytes.
    pub bytes: u64,
}

/// Result of an exploration: its figures and, if kept, its states.
pub struct Exploration {
    /// Counts and maxima.
    pub figures: Figures,
    /// Reason why the exploration ended.
    pub stop: Stop,
    /// The wanted state, if one was found.
    pub found: Option<Vec<u64>>,
    pub(super) machine: Machine,
    pub(super) shards: Vec<Shard>,
    /// States in the order of their numbers, computed when first needed.
    pub(super) stretches: OnceLock<Vec<Stretch>>,
}

impl Exploration {
    /// Returns the figures as progress, for watchers of later work on the states.
    #[must_use]
    pub fn progress(&self) -> Progress {
        let Figures { states, depth, bytes, .. } = self.figures;
        Progress { states, expanded: states, depth, bytes }
    }

    pub(super) fn refused(reason: String) -> Self {
        let bounds = super::cover::Bounds::of(&[], &[]);
        let machine = Machine::new(&[], &[], &bounds, &[]);
        let stop = Stop::Refused(reason);
        Self { figures: Figures::default(), stop, found: None, machine, shards: Vec::new(), stretches: OnceLock::new() }
    }
}
