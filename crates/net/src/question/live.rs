//! Liveness, from the strongly connected components that nothing leaves: a net of which every transition fires once is live if
//! each of them has every transition.

use std::sync::atomic::{AtomicBool, Ordering};

use fixedbitset::FixedBitSet;

use super::Reply;
use super::examination::{dead_for_ever, shown_at};
use super::paths::Paths;
use crate::net::TransitionId;
use petril_logic::{Valuation, leading_to};
use petril_search::{Stop, components_until};

/// Whether the net is live, as far as the states tell that. A transition that fires no more is shown where it was lost.
pub(super) fn live(paths: &Paths<'_>, stopping: &AtomicBool) -> Option<Reply> {
    let Paths { net, exploration, graph } = paths;
    let mut initial = FixedBitSet::with_capacity(graph.len());
    initial.insert(0);
    // From the others no way leads back. If there are none, all states are one component.
    let mut others = leading_to(graph, &initial, stopping);
    others.toggle_range(..);
    if stopping.load(Ordering::Relaxed) {
        return None;
    }
    let components = components_until(graph, &others, stopping)?;
    let mut is_left = FixedBitSet::with_capacity(components.count);
    for state in others.ones().map(|state| state as u32) {
        let own = components.of[state as usize];
        // A state that was not expanded, and the one that stands for the unknown ones, tell nothing.
        let leads_on = graph.successors(state).iter().any(|&next| components.of[next as usize] != own);
        is_left.set(own as usize, is_left.contains(own as usize) || leads_on || graph.row_of(state).is_none());
    }
    if stopping.load(Ordering::Relaxed) {
        return None;
    }
    // The components that are not left, in the order of their nearest states.
    let mut number_of = vec![None; components.count];
    let mut nearest = Vec::new();
    for state in others.ones() {
        let component = components.of[state] as usize;
        if !is_left.contains(component) && number_of[component].is_none() {
            number_of[component] = Some(nearest.len());
            nearest.push(state as u32);
        }
    }
    let number = |state: u32| number_of.get(components.of[state as usize] as usize).copied().flatten();
    let transitions = net.transitions().len();
    let Some((component, lost)) = exploration.first_lacking(nearest.len(), &number, transitions, stopping)? else {
        return (*graph.stop() == Stop::Complete).then_some(Reply::Holds(None));
    };
    let lost: Vec<TransitionId> = lost.into_iter().map(TransitionId::at).collect();
    let marking = exploration.marking(nearest[component])?;
    let claims = lost.iter().copied().map(dead_for_ever).collect();
    Some(shown_at(net, exploration, &marking, claims, |played| lost.iter().all(|&t| !played.is_enabled(t))))
}
