//! Behavioural properties of a net by its reachability graph: deadlocks, dead transitions, liveness.

use std::sync::atomic::{AtomicBool, Ordering};

use fixedbitset::FixedBitSet;

use super::exploration::Exploration;
use crate::net::TransitionId;
use petril_search::Stop;
use petril_search::tarjan;

/// Behavioural properties of a net whose reachability graph is complete.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Behaviour {
    /// Number of reachable markings in which no transition is enabled.
    pub deadlocks: u64,
    /// Dead transitions: those that never fire.
    pub dead: Vec<TransitionId>,
    /// Whether every transition that is not dead is live: from every reachable marking it can fire again.
    pub live_without_dead: bool,
}

/// Number of bits for groups of states examined together: 32 MiB.
const TOGETHER: usize = 1 << 28;

impl Exploration {
    /// Determines the behavioural properties from a complete exploration. `None` if it is not complete, its states were
    /// not kept, there is too little memory for the graph, or `stopping` is set meanwhile.
    #[must_use]
    pub fn behaviour(&self, stopping: &AtomicBool) -> Option<Behaviour> {
        let dead: Vec<TransitionId> = self.figures.never_enabled.iter().map(|&id| TransitionId::at(id)).collect();
        let alive = self.machine.transitions - dead.len();
        if self.stop != Stop::Complete {
            return None;
        }
        // In a deadlock no transition is live.
        let live_without_dead =
            if self.figures.deadlocks > 0 { alive == 0 } else { self.fires_everywhere(alive, stopping)? };
        Some(Behaviour { deadlocks: self.figures.deadlocks, dead, live_without_dead })
    }

    /// Finds a nearest marking kept in which a place has more than one token, and the place.
    #[must_use]
    pub fn second_token(&self) -> Option<(usize, Vec<u64>)> {
        const BLOCK: usize = 1 << 12;
        let maxima = self.figures.place_maxima.iter().enumerate();
        let places: Vec<usize> = maxima.filter(|&(_, &most)| most > 1).map(|(place, _)| place).collect();
        if places.is_empty() {
            return None;
        }
        let states = self.kept();
        (0..states).step_by(BLOCK).find_map(|first| {
            let mut found = None;
            self.for_states(first as u32..states.min(first + BLOCK) as u32, |_, view| {
                let crowded = || places.iter().copied().find(|&place| view.tokens(place) > 1);
                found = found.take().or_else(|| crowded().map(|place| (place, view.marking())));
            });
            found
        })
    }

    /// Whether `alive` transitions fire in each bottom strongly connected component.
    fn fires_everywhere(&self, alive: usize, stopping: &AtomicBool) -> Option<bool> {
        let steps = self.steps(stopping)?;
        let mut all = FixedBitSet::with_capacity(steps.rows());
        all.insert_range(..);
        let (component, count) = tarjan(steps.rows(), &all, |state| steps.successors(state), stopping)?;
        let mut is_left = vec![false; count];
        for state in 0..steps.rows() as u32 {
            let own = component[state as usize];
            is_left[own as usize] |= steps.successors(state).iter().any(|&next| component[next as usize] != own);
        }
        let bottom: Vec<usize> = (0..count).filter(|&component| !is_left[component]).collect();
        let group = |state: u32| bottom.binary_search(&(component[state as usize] as usize)).ok();
        Some(self.first_lacking(bottom.len(), &group, alive, stopping)?.is_none())
    }

    /// Finds the first of `groups` sets of states, which `group` numbers, that enables fewer than `all` transitions,
    /// and the transitions that it does not enable. The outer `None` means that `stopping` was set meanwhile.
    pub(crate) fn first_lacking(
        &self,
        groups: usize,
        group: &dyn Fn(u32) -> Option<usize>,
        all: usize,
        stopping: &AtomicBool,
    ) -> Option<Option<(usize, Vec<usize>)>> {
        const BLOCK: usize = 1 << 12;
        let transitions = self.machine.transitions;
        let states = self.kept();
        // A bit for each group and transition may take too much memory at once.
        let together = (TOGETHER / transitions.max(1)).max(1);
        for begin in (0..groups).step_by(together) {
            let end = groups.min(begin + together);
            let mut enabled = FixedBitSet::with_capacity((end - begin) * transitions);
            for first in (0..states).step_by(BLOCK) {
                if stopping.load(Ordering::Relaxed) {
                    return None;
                }
                self.for_states(first as u32..states.min(first + BLOCK) as u32, |state, view| {
                    if let Some(row) = group(state).filter(|row| (begin..end).contains(row)) {
                        view.enabled().for_each(|transition| enabled.insert((row - begin) * transitions + transition));
                    }
                });
            }
            let row = |group: usize| (group - begin) * transitions..(group - begin + 1) * transitions;
            if let Some(lacking) = (begin..end).find(|&group| enabled.count_ones(row(group)) < all) {
                let start = row(lacking).start;
                let lost = (0..transitions).filter(|transition| !enabled.contains(start + transition)).collect();
                return Some(Some((lacking, lost)));
            }
        }
        Some(None)
    }
}
