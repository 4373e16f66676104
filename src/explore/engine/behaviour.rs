//! What the reachability graph of a net says of its behaviour: deadlocks, dead transitions, live.

use std::sync::atomic::AtomicBool;

use fixedbitset::FixedBitSet;

use super::exploration::Exploration;
use super::graph::Steps;
use crate::explore::budget::Stop;
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
        if self.stop != Stop::Complete {
            return None;
        }
        let steps = self.steps(&AtomicBool::new(false))?;
        // A deadlock fires nothing for ever.
        let live_without_dead =
            if self.figures.deadlocks > 0 { alive == 0 } else { self.fires_everywhere(&steps, transitions, alive) };
        Some(Behaviour { deadlocks: self.figures.deadlocks, dead, live_without_dead })
    }

    /// One of the nearest markings kept in which a place has more than one token, and the place.
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

    /// Whether so many transitions fire in each component that no step leaves.
    fn fires_everywhere(&self, steps: &Steps, transitions: usize, alive: usize) -> bool {
        let mut all = FixedBitSet::with_capacity(steps.states());
        all.insert_range(..);
        let (component, count) = tarjan(steps.states(), &all, |state| steps.successors(state));
        let mut is_left = vec![false; count];
        for state in 0..steps.states() as u32 {
            let own = component[state as usize];
            is_left[own as usize] |= steps.successors(state).iter().any(|&next| component[next as usize] != own);
        }
        let bottom: Vec<usize> = (0..count).filter(|&component| !is_left[component]).collect();
        let mut fired = FixedBitSet::with_capacity(bottom.len() * transitions);
        self.for_each_state(|state, view| {
            if let Ok(row) = bottom.binary_search(&(component[state as usize] as usize)) {
                view.enabled().for_each(|transition| fired.insert(row * transitions + transition));
            }
        });
        (0..bottom.len()).all(|row| fired.count_ones(row * transitions..(row + 1) * transitions) == alive)
    }
}
