//! Summary of a net's structure, computed within limits.

use super::state_equation::{Bound, Problem};
use super::{
    Class, Commoner, Components, Flow, Incidence, Invariants, Limits, PlaceInvariant, SiphonLimits, Siphons,
    TransitionInvariant, commoner, minimal_siphons, minimal_traps, place_basis, place_invariants, starved,
    transition_invariants,
};
use crate::net::{Net, PlaceId, TransitionId};

/// Maximum number of elementary steps for the rank, and for the bound on all tokens.
const STEPS: u64 = 100_000_000;

/// Structural properties of a net.
#[derive(Clone, Debug)]
pub struct Summary {
    /// Structural classes.
    pub class: Class,
    /// Connected components.
    pub components: Components,
    /// Rank of the incidence matrix, if it could be computed. The number of independent place invariants is the number
    /// of places minus the rank, and likewise for transitions.
    pub rank: Option<usize>,
    /// Minimal place invariants.
    pub place_invariants: Invariants<PlaceInvariant>,
    /// Minimal transition invariants.
    pub transition_invariants: Invariants<TransitionInvariant>,
    /// Upper bound on the tokens of each place by place invariants.
    pub place_bounds: Vec<Option<u64>>,
    /// Upper bound on the total number of tokens by the state equation, with proof.
    pub bound: Option<Bound>,
    /// Minimal siphons.
    pub siphons: Siphons,
    /// Minimal traps.
    pub traps: Siphons,
    /// Commoner's property: whether every siphon contains a trap that is marked initially.
    pub commoner: Commoner,
    /// Transitions that never fire, since they need tokens of an initially empty siphon.
    pub starved: Vec<TransitionId>,
    /// Whether siphons and traps imply that there is no deadlock.
    pub excludes_deadlock: bool,
    /// Whether the net is live, if siphons and traps decide it.
    pub is_live: Option<bool>,
}

impl Summary {
    /// Analyses a net. Limits are `effort` times those that keep every part below about a second.
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

    /// Whether every place is covered by a place invariant, so that the net is bounded for every initial marking;
    /// `None` if too few invariants were found to tell.
    #[must_use]
    pub fn is_conservative(&self) -> Option<bool> {
        let parts = self.place_invariants.found.iter().flat_map(|one| &one.weights).map(|(place, _)| place.index());
        covers(self.place_bounds.len(), parts, self.place_invariants.all)
    }

    /// Whether every transition is covered by a transition invariant, as is necessary for a live and bounded net;
    /// `None` if too few invariants were found to tell.
    #[must_use]
    pub fn is_consistent(&self, net: &Net) -> Option<bool> {
        let parts = self.transition_invariants.found.iter().flat_map(|one| &one.firings).map(|(id, _)| id.index());
        covers(net.transitions().len(), parts, self.transition_invariants.all)
    }

    /// Upper bound on the tokens of any place, if place invariants bound all places.
    #[must_use]
    pub fn most_in_place(&self) -> Option<u64> {
        self.place_bounds.iter().copied().try_fold(0, |most, bound| Some(most.max(bound?)))
    }
}

/// Upper bound on the tokens of each place by place invariants.
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

/// Whether parts cover everything; `None` if they do not and the list of parts is incomplete.
fn covers(count: usize, parts: impl Iterator<Item = usize>, all: bool) -> Option<bool> {
    let mut covered = vec![false; count];
    parts.for_each(|part| covered[part] = true);
    let is_covered = covered.into_iter().all(|covered| covered);
    (is_covered || all).then_some(is_covered)
}
