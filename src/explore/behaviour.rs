//! What the reachability graph of a net says of its behaviour: safe, deadlocks, dead transitions, live.

use std::collections::BTreeMap;

use fixedbitset::FixedBitSet;
use rayon::prelude::*;

use super::components::components;
use super::graph::Graph;
use super::markings::Markings;
use super::space::{Failure, Step};
use crate::net::{PlaceId, TransitionId};

/// The behaviour of a net whose reachability graph is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Behaviour {
    /// Reachable markings where no transition is enabled.
    pub deadlocks: usize,
    /// Transitions that never fire.
    pub dead: Vec<TransitionId>,
    /// Whether, from every reachable marking, every transition that is not dead can fire again.
    pub live_without_dead: bool,
}

/// The behaviour a complete graph shows.
#[must_use]
pub fn behaviour(markings: &Markings<'_>) -> Behaviour {
    let graph = markings.graph();
    let count = markings.net().transitions().len();
    let add = |mut fired: FixedBitSet, state: u32| {
        markings.firings(graph.state(state), &mut |transition, _| fired.insert(transition.index()));
        fired
    };
    let none = || FixedBitSet::with_capacity(count);
    let fired = (0..graph.len() as u32).into_par_iter().fold(none, add).reduce(none, |a, b| &a | &b);
    let deadlocks = graph.ids().filter(|&state| graph.successors(state).is_empty()).count();
    // A deadlock fires nothing for ever.
    let live_without_dead = if deadlocks > 0 {
        fired.is_clear()
    } else {
        fired_in_bottom_components(graph, none, add).iter().all(|by| *by == fired)
    };
    let dead = (0..count).filter(|&t| !fired.contains(t)).map(TransitionId::at).collect();
    Behaviour { deadlocks, dead, live_without_dead }
}

/// For each component that no step leaves, the transitions that fire in it.
fn fired_in_bottom_components(
    graph: &Graph,
    none: impl Fn() -> FixedBitSet,
    add: impl Fn(FixedBitSet, u32) -> FixedBitSet,
) -> Vec<FixedBitSet> {
    let mut all = FixedBitSet::with_capacity(graph.len());
    all.insert_range(..);
    let components = components(graph, &all);
    let mut bottom = FixedBitSet::with_capacity(components.count);
    bottom.insert_range(..);
    for state in graph.ids() {
        let own = components.of[state as usize];
        if graph.successors(state).iter().any(|&next| components.of[next as usize] != own) {
            bottom.set(own as usize, false);
        }
    }
    let mut fired_by: BTreeMap<u32, FixedBitSet> = BTreeMap::new();
    for state in graph.ids() {
        let own = components.of[state as usize];
        if bottom.contains(own as usize) {
            let fired = fired_by.remove(&own).unwrap_or_else(&none);
            fired_by.insert(own, add(fired, state));
        }
    }
    fired_by.into_values().collect()
}

/// A firing that puts a second token on a place: the state it starts from, the transition, the place.
#[must_use]
pub fn unsafe_firing(markings: &Markings<'_>) -> Option<(u32, TransitionId, PlaceId)> {
    let graph = markings.graph();
    let state = graph.failures().iter().find_map(|&(state, _)| state)?;
    let mut found = None;
    markings.firings(graph.state(state), &mut |transition, step| {
        if let (None, Step::Fails(Failure::NotSafe(place))) = (found, step) {
            found = Some((state, transition, place));
        }
    });
    found
}
