//! What an exploration leaves.

use std::sync::OnceLock;

use super::machine::Machine;
use super::numbering::Stretch;
use super::shard::Shard;
use petril_search::{Progress, Stop};

/// The figures of an exploration. If it was not completed, they are those of the part explored.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Figures {
    /// States found.
    pub states: u64,
    /// Of these, states that were looked at and fired from.
    pub expanded: u64,
    /// Pairs of an expanded state and a transition it enables.
    pub transitions: u64,
    /// Firings tried. The others were known to lead to no new state. Depends on the number of threads.
    pub fired: u64,
    /// The largest number of tokens in one place of a state.
    pub max_tokens_in_place: u64,
    /// The largest number of tokens in a state.
    pub max_tokens_in_marking: u64,
    /// The largest number of tokens of each place.
    pub place_maxima: Vec<u64>,
    /// The transitions that no expanded state enables.
    pub never_enabled: Vec<usize>,
    /// Expanded states that enable no transition.
    pub deadlocks: u64,
    /// One of the nearest deadlocks, always the same one.
    pub deadlock: Option<Vec<u64>>,
    /// The largest distance of an expanded state from the initial one, in firings.
    pub depth: usize,
    /// Bits of a packed marking.
    pub bits: u32,
    /// Bytes in use at the end.
    pub bytes: u64,
}

/// The states reached, and what is known of them.
pub struct Exploration {
    /// Counts and maxima.
    pub figures: Figures,
    /// Why the exploration ended.
    pub stop: Stop,
    /// The state of which the wanted property was true, if one was found.
    pub found: Option<Vec<u64>>,
    pub(super) machine: Machine,
    pub(super) shards: Vec<Shard>,
    /// The states in the order of their numbers, once somebody has asked for them.
    pub(super) stretches: OnceLock<Vec<Stretch>>,
}

impl Exploration {
    /// The figures as those of a search under way, for whoever watches work on what it found.
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
