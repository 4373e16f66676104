//! A net together with where its nodes stand in the file it was read from.

use super::{Net, PlaceId, TransitionId};
use crate::source::Span;

/// A net read from a text, so that diagnostics can point at its nodes.
#[derive(Clone, Debug)]
pub struct Located {
    /// The net.
    pub net: Net,
    /// Where each place is defined, or first used where the format needs no definition.
    pub places: Vec<Span>,
    /// Where each transition is defined.
    pub transitions: Vec<Span>,
}

impl Located {
    /// Where a place stands.
    #[must_use]
    pub fn place_span(&self, place: PlaceId) -> Span {
        self.places[place.index()]
    }

    /// Where a transition stands.
    #[must_use]
    pub fn transition_span(&self, transition: TransitionId) -> Span {
        self.transitions[transition.index()]
    }
}
