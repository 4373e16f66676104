//! What siphons and traps say about behaviour: Commoner's property and what follows from it.
//!
//! If every siphon holds a trap that is marked initially, no siphon ever becomes empty. Where transitions need one token of each
//! input, a deadlock leaves an input of every transition empty, and these places are a siphon: so there is no deadlock. In ordinary
//! extended free choice nets the property holds if and only if the net is live (Commoner's theorem, Hack 1972).

use fixedbitset::FixedBitSet;

use super::class::Class;
use super::flow::Flow;
use super::largest::{largest_siphon, largest_trap};
use super::siphons::Siphons;
use crate::net::{Net, PlaceId, TransitionId};

/// Whether every siphon holds a trap that is marked initially.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Commoner {
    /// Every one does.
    Holds,
    /// This minimal siphon does not.
    Fails(Vec<PlaceId>),
    /// Not all minimal siphons are known; those that are do.
    Unknown,
}

/// Whether each of the minimal siphons of a net holds a marked trap. Places without arcs are left out: they are siphons that
/// nothing depends on.
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

/// The transitions that can never fire since they need tokens of a siphon that is empty initially: the largest there is.
#[must_use]
pub fn starved(net: &Net, flow: &Flow) -> Vec<TransitionId> {
    let mut empty = FixedBitSet::with_capacity(flow.places());
    net.place_ids().filter(|&place| !net.place(place).is_marked()).for_each(|place| empty.insert(place.index()));
    let siphon = largest_siphon(flow, &empty);
    let starves = |id: &TransitionId| flow.inputs[id.index()].iter().any(|&place| siphon.contains(place as usize));
    net.transition_ids().filter(starves).collect()
}

impl Commoner {
    /// Whether it follows that no reachable marking is a deadlock. Nothing follows from the property's failing.
    #[must_use]
    pub fn excludes_deadlock(&self, class: &Class, flow: &Flow) -> bool {
        *self == Self::Holds && class.single_inputs && flow.transitions() > 0
    }

    /// Whether it follows that the net is live, or that it is not.
    #[must_use]
    pub fn decides_liveness(&self, class: &Class) -> Option<bool> {
        match self {
            Self::Holds if class.extended_free_choice => Some(true),
            Self::Fails(_) if class.extended_free_choice => Some(false),
            _ => None,
        }
    }
}
