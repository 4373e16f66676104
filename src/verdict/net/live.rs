//! Liveness, from the strongly connected components that nothing leaves: a net of which every transition fires once is live if
//! each of them has every transition.

use std::sync::atomic::{AtomicBool, Ordering};

use fixedbitset::FixedBitSet;

use super::Reply;
use super::examination::{dead_for_ever, shown_at};
use super::paths::Paths;
use crate::explore::{Stop, components};
use crate::logic::{Valuation, leading_to};
use crate::net::TransitionId;

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
    let components = components(graph, &others);
    let mut is_left = FixedBitSet::with_capacity(components.count);
    for state in others.ones().map(|state| state as u32) {
        let own = components.of[state as usize];
        // The state that stands for the unknown ones has no steps, and tells nothing.
        let leads_on = graph.successors(state).iter().any(|&next| components.of[next as usize] != own);
        is_left.set(own as usize, is_left.contains(own as usize) || leads_on || graph.row_of(state).is_none());
    }
    if stopping.load(Ordering::Relaxed) {
        return None;
    }
    // The transitions of the components that are not left, numbered by how many such there are before them.
    let mut numbers = vec![0; components.count];
    let mut count = 0;
    for component in is_left.zeroes() {
        numbers[component] = count;
        count += 1;
    }
    let transitions = net.transitions().len();
    let mut fired = FixedBitSet::with_capacity(count * transitions);
    let number = |state: u32| {
        let component = components.of[state as usize] as usize;
        (others.contains(state as usize) && !is_left.contains(component)).then(|| numbers[component])
    };
    exploration.for_each_state(|state, view| {
        if let Some(number) = number(state) {
            view.enabled().for_each(|transition| fired.insert(number * transitions + transition));
        }
    });
    let lost = |state: u32| -> Vec<usize> {
        let row = number(state).map(|number| number * transitions);
        row.map(|row| (0..transitions).filter(|t| !fired.contains(row + t)).collect()).unwrap_or_default()
    };
    let is_full: Vec<bool> =
        (0..count).map(|n| fired.count_ones(n * transitions..(n + 1) * transitions) == transitions).collect();
    let state =
        others.ones().map(|state| state as u32).find(|&state| number(state).is_some_and(|number| !is_full[number]));
    let Some(state) = state else { return (*graph.stop() == Stop::Complete).then_some(Reply::Holds(None)) };
    let lost: Vec<TransitionId> = lost(state).into_iter().map(TransitionId::at).collect();
    let marking = exploration.marking(state)?;
    let claims = lost.iter().copied().map(dead_for_ever).collect();
    Some(shown_at(net, exploration, &marking, claims, |played| lost.iter().all(|&t| !played.is_enabled(t))))
}
