//! Liveness from the terminal strongly connected components: a net whose transitions are all quasi-live is live if
//! every terminal component fires every transition.

use std::sync::atomic::{AtomicBool, Ordering};

use fixedbitset::FixedBitSet;

use super::Reply;
use super::examination::{dead_for_ever, shown_at};
use super::paths::Paths;
use crate::net::TransitionId;
use petril_logic::{Valuation, leading_to};
use petril_search::{Stop, components_until};

/// Decides liveness as far as the explored states can. A transition that has died is shown at the nearest state where
/// it has.
pub(super) fn live(paths: &Paths<'_>, stopping: &AtomicBool) -> Option<Reply> {
    let Paths { net, exploration, graph } = paths;
    let mut initial = FixedBitSet::with_capacity(graph.len());
    initial.insert(0);
    // The other states have no path back to the initial one. If there are none, the graph is one component.
    let mut others = leading_to(graph, &initial, stopping);
    others.toggle_range(..);
    if stopping.load(Ordering::Relaxed) {
        return None;
    }
    let components = components_until(graph, &others, stopping)?;
    let mut is_left = FixedBitSet::with_capacity(components.count);
    for state in others.ones().map(|state| state as u32) {
        let own = components.of[state as usize];
        // Unexpanded states, and the one that stands for all unknown states, decide nothing: their components count as
        // left.
        let leads_on = graph.successors(state).iter().any(|&next| components.of[next as usize] != own);
        is_left.set(own as usize, is_left.contains(own as usize) || leads_on || graph.row_of(state).is_none());
    }
    if stopping.load(Ordering::Relaxed) {
        return None;
    }
    // Terminal components, in the order of their nearest states.
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
