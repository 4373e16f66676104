//! Commoner's property: deadlock-freedom and liveness from siphons and traps.
//!
//! If every siphon contains a trap that is marked initially, no siphon ever becomes empty. If transitions need one
//! token of each input, then in a deadlock every transition has an empty input place, and the empty places form a
//! siphon: so there is no deadlock. Ordinary extended free-choice nets are live if and only if they have the property
//! (Commoner's theorem, Hack 1972).

use fixedbitset::FixedBitSet;

use super::class::Class;
use super::flow::Flow;
use super::largest::{largest_siphon, largest_trap};
use super::siphons::Siphons;
use crate::net::{Net, PlaceId, TransitionId};

/// Commoner's property: every siphon contains a trap that is marked initially.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Commoner {
    /// The property holds.
    Holds,
    /// The property fails: this minimal siphon contains no initially marked trap.
    Fails(Vec<PlaceId>),
    /// Unknown: all minimal siphons found contain a marked trap, but there may be more siphons.
    Unknown,
}

/// Checks whether every minimal siphon of a net contains an initially marked trap. Places without arcs are left out:
/// they are siphons on which nothing depends.
#[must_use]
pub fn commoner(net: &Net, flow: &Flow, siphons: &Siphons) -> Commoner {
    let is_isolated = |siphon: &[PlaceId]| siphon.iter().all(|place| flow.consumers[place.index()].is_empty());
    for siphon in siphons.found.iter().filter(|siphon| !is_isolated(siphon)) {
        let mut within = FixedBitSet::with_capacity(flow.places());
        siphon.iter().for_each(|place| within.insert(place.index()));
        if !largest_trap(flow, &within).ones().any(|place| net.place(PlaceId::at(place)).is_marked()) {
            return Commoner::Fails(siphon.clone());
        }
    }
    if siphons.all { Commoner::Holds } else { Commoner::Unknown }
}

/// The transitions that can never fire since they need tokens of the largest siphon that is empty initially.
#[must_use]
pub fn starved(net: &Net, flow: &Flow) -> Vec<TransitionId> {
    let mut empty = FixedBitSet::with_capacity(flow.places());
    net.place_ids().filter(|&place| !net.place(place).is_marked()).for_each(|place| empty.insert(place.index()));
    let siphon = largest_siphon(flow, &empty);
    let starves = |id: &TransitionId| flow.inputs[id.index()].iter().any(|&place| siphon.contains(place as usize));
    net.transition_ids().filter(starves).collect()
}

impl Commoner {
    /// Whether the property implies that no reachable marking is a deadlock. If it fails, nothing follows.
    #[must_use]
    pub fn excludes_deadlock(&self, class: &Class, flow: &Flow) -> bool {
        *self == Self::Holds && class.single_inputs && flow.transitions() > 0
    }

    /// Whether the net is live, if the property decides it (extended free-choice nets only).
    #[must_use]
    pub fn decides_liveness(&self, class: &Class) -> Option<bool> {
        match self {
            Self::Holds if class.extended_free_choice => Some(true),
            Self::Fails(_) if class.extended_free_choice => Some(false),
            _ => None,
        }
    }
}
