//! Everything that is said of a net's structure, at once and within limits.

use super::state_equation::{Bound, Problem};
use super::{
    Class, Commoner, Components, Flow, Incidence, Invariants, Limits, PlaceInvariant, SiphonLimits, Siphons,
    TransitionInvariant, commoner, minimal_siphons, minimal_traps, place_basis, place_invariants, starved,
    transition_invariants,
};
use crate::net::{Net, PlaceId, TransitionId};

/// Elementary steps that the rank, and the bound on all tokens, may take.
const STEPS: u64 = 100_000_000;

/// The structure of a net.
#[derive(Clone, Debug)]
pub struct Summary {
    /// Classes by the shape of arcs.
    pub class: Class,
    /// How the net hangs together.
    pub components: Components,
    /// The rank of the incidence matrix, if it could be computed: so many fewer than places are the independent place
    /// invariants, so many fewer than transitions the independent transition invariants.
    pub rank: Option<usize>,
    /// Minimal place invariants.
    pub place_invariants: Invariants<PlaceInvariant>,
    /// Minimal transition invariants.
    pub transition_invariants: Invariants<TransitionInvariant>,
    /// What place invariants say a place has at most, place by place.
    pub place_bounds: Vec<Option<u64>>,
    /// The most tokens in a marking as the state equation limits them, with the proof.
    pub bound: Option<Bound>,
    /// Minimal siphons.
    pub siphons: Siphons,
    /// Minimal traps.
    pub traps: Siphons,
    /// Whether every siphon holds a trap that is marked initially.
    pub commoner: Commoner,
    /// Transitions that never fire, since they need tokens of a siphon that has none.
    pub starved: Vec<TransitionId>,
    /// Whether it follows from siphons and traps that there is no deadlock.
    pub excludes_deadlock: bool,
    /// Whether it follows from siphons and traps that the net is live, or that it is not.
    pub is_live: Option<bool>,
}

impl Summary {
    /// The structure of a net. Limits are so many times those that keep every part below about a second.
    #[must_use]
    pub fn of(net: &Net, effort: u32) -> Self {
        let times = u64::from(effort);
        let flow = Flow::of(net);
        let incidence = Incidence::of(net);
        let usual = Limits::default();
        let limits = Limits {
            rows_each: usual.rows_each.saturating_mul(effort as usize),
            rows: usual.rows.saturating_mul(effort as usize),
            work: usual.work.saturating_mul(times),
        };
        let usual = SiphonLimits::default();
        let siphon_limits = SiphonLimits {
            count: usual.count.saturating_mul(effort as usize),
            steps: usual.steps.saturating_mul(times),
        };
        let steps = STEPS.saturating_mul(times);

        let class = Class::of(net, &flow);
        let place_invariants = place_invariants(net, &incidence, limits);
        let siphons = minimal_siphons(&flow, siphon_limits);
        let commoner = commoner(net, &flow, &siphons);
        let places: Vec<PlaceId> = net.place_ids().collect();
        Self {
            components: Components::of(&flow),
            rank: place_basis(net, &incidence, steps).map(|basis| basis.rank),
            place_bounds: place_bounds(net, &place_invariants.found),
            place_invariants,
            transition_invariants: transition_invariants(net, &incidence, limits),
            bound: Problem::new(net).bound(&places, steps),
            siphons,
            traps: minimal_traps(&flow, siphon_limits),
            excludes_deadlock: commoner.excludes_deadlock(&class, &flow),
            is_live: commoner.decides_liveness(&class),
            commoner,
            starved: starved(net, &flow),
            class,
        }
    }

    /// Whether every place is part of a place invariant, so that the net is bounded whatever its initial marking; nothing if
    /// too few invariants were found to tell.
    #[must_use]
    pub fn is_conservative(&self) -> Option<bool> {
        let parts = self.place_invariants.found.iter().flat_map(|one| &one.weights).map(|(place, _)| place.index());
        covers(self.place_bounds.len(), parts, self.place_invariants.all)
    }

    /// Whether every transition is part of a transition invariant, as it must be in a net that is live and bounded; nothing if
    /// too few invariants were found to tell.
    #[must_use]
    pub fn is_consistent(&self, net: &Net) -> Option<bool> {
        let parts = self.transition_invariants.found.iter().flat_map(|one| &one.firings).map(|(id, _)| id.index());
        covers(net.transitions().len(), parts, self.transition_invariants.all)
    }

    /// The most tokens a place can have, if place invariants limit all places.
    #[must_use]
    pub fn most_in_place(&self) -> Option<u64> {
        self.place_bounds.iter().copied().try_fold(0, |most, bound| Some(most.max(bound?)))
    }
}

/// What place invariants say a place has at most, place by place.
fn place_bounds(net: &Net, invariants: &[PlaceInvariant]) -> Vec<Option<u64>> {
    let mut bounds: Vec<Option<u64>> = vec![None; net.places().len()];
    for invariant in invariants {
        for &(place, weight) in &invariant.weights {
            let bound = invariant.tokens / weight;
            let known = &mut bounds[place.index()];
            *known = Some(known.map_or(bound, |known| known.min(bound)));
        }
    }
    bounds
}

/// Whether parts cover everything; if they do not, and are not all, nobody knows.
fn covers(count: usize, parts: impl Iterator<Item = usize>, all: bool) -> Option<bool> {
    let mut covered = vec![false; count];
    parts.for_each(|part| covered[part] = true);
    let is_covered = covered.into_iter().all(|covered| covered);
    (is_covered || all).then_some(is_covered)
}
