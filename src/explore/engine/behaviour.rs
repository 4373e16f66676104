//! What the reachability graph of a net says of its behaviour: deadlocks, dead transitions, live.

use fixedbitset::FixedBitSet;

use super::exploration::Exploration;
use super::graph::Steps;
use crate::explore::tarjan::tarjan;
use crate::net::TransitionId;

/// The behaviour of a net whose reachability graph is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Behaviour {
    /// Reachable markings where no transition is enabled.
    pub deadlocks: u64,
    /// Transitions that never fire.
    pub dead: Vec<TransitionId>,
    /// Whether, from every reachable marking, every transition that is not dead can fire again.
    pub live_without_dead: bool,
}

impl Exploration {
    /// The behaviour a complete exploration shows. Nothing if it is not complete, or its states were not kept.
    #[must_use]
    pub fn behaviour(&self) -> Option<Behaviour> {
        let dead: Vec<TransitionId> = self.figures.never_enabled.iter().map(|&id| TransitionId::at(id)).collect();
        let transitions = self.machine.transitions;
        let alive = transitions - dead.len();
        let steps = self.steps(true)?;
        // A deadlock fires nothing for ever.
        let live_without_dead =
            if self.figures.deadlocks > 0 { alive == 0 } else { fires_everywhere(&steps, transitions, alive) };
        Some(Behaviour { deadlocks: self.figures.deadlocks, dead, live_without_dead })
    }
}

/// Whether so many transitions fire in each component that no step leaves.
fn fires_everywhere(steps: &Steps, transitions: usize, alive: usize) -> bool {
    let mut all = FixedBitSet::with_capacity(steps.states());
    all.insert_range(..);
    let (component, count) = tarjan(steps.states(), &all, |state| steps.successors(state));
    let mut is_bottom = vec![true; count];
    for state in 0..steps.states() as u32 {
        let own = component[state as usize];
        is_bottom[own as usize] &= steps.successors(state).iter().all(|&next| component[next as usize] == own);
    }
    let mut states: Vec<u32> =
        (0..steps.states() as u32).filter(|&state| is_bottom[component[state as usize] as usize]).collect();
    states.sort_unstable_by_key(|&state| component[state as usize]);
    states.chunk_by(|&a, &b| component[a as usize] == component[b as usize]).all(|states| {
        let mut fired = FixedBitSet::with_capacity(transitions);
        states.iter().flat_map(|&state| steps.fired(state)).for_each(|&id| fired.insert(id as usize));
        fired.count_ones(..) == alive
    })
}
