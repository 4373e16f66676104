//! The flow relation: presets and postsets of places and transitions, without weights. A read place is in both the
//! preset and the postset of its transition.

use crate::net::{Net, PlaceId, TransitionId};
use petril_base::Rows;

/// Presets and postsets of all transitions and of all places, each ascending.
#[derive(Clone, Debug)]
pub struct Flow {
    /// Preset of each transition.
    pub(super) inputs: Rows<u32>,
    /// Postset of each transition.
    pub(super) outputs: Rows<u32>,
    /// Preset of each place: the transitions that put tokens on it.
    pub(super) producers: Rows<u32>,
    /// Postset of each place: the transitions that need its tokens.
    pub(super) consumers: Rows<u32>,
    places: usize,
    transitions: usize,
}

impl Flow {
    /// Returns the flow relation of a net.
    #[must_use]
    pub fn of(net: &Net) -> Self {
        let (places, transitions) = (net.places().len(), net.transitions().len());
        let pair = |id: TransitionId, place: PlaceId| (id.index(), place.index() as u32);
        let before = net.transition_ids().flat_map(|id| net.pre(id).map(move |(place, _)| pair(id, place)));
        let behind = net.transition_ids().flat_map(|id| net.post(id).map(move |(place, _)| pair(id, place)));
        let turned = |(id, place): (usize, u32)| (place as usize, id as u32);
        Self {
            inputs: Rows::group(transitions, before.clone()),
            outputs: Rows::group(transitions, behind.clone()),
            producers: Rows::group(places, behind.map(turned)),
            consumers: Rows::group(places, before.map(turned)),
            places,
            transitions,
        }
    }

    /// Returns the flow relation with all arcs reversed: siphons become traps.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self {
            inputs: self.outputs.clone(),
            outputs: self.inputs.clone(),
            producers: self.consumers.clone(),
            consumers: self.producers.clone(),
            ..*self
        }
    }

    pub(super) fn places(&self) -> usize {
        self.places
    }

    pub(super) fn transitions(&self) -> usize {
        self.transitions
    }
}
