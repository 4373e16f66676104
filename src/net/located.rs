//! A net together with where its nodes stand in the file it was read from.

use super::{Net, PlaceId, TransitionId, Units};
use petril_base::diagnostic::Diagnostic;
use petril_base::source::Span;

/// A net read from a text, so that diagnostics can point at its nodes.
#[derive(Clone, Debug)]
pub struct Located {
    /// The net.
    pub net: Net,
    /// Where each place is defined, or first used where the format needs no definition.
    pub places: Vec<Span>,
    /// Where each transition is defined.
    pub transitions: Vec<Span>,
    /// The places that are used and not declared, where the format needs no declaration.
    pub undeclared: Vec<PlaceId>,
    /// The ids of places and transitions in the file, by position; none where the format knows names only.
    pub ids: Option<(Vec<String>, Vec<String>)>,
    /// The units of its places, if the file has them.
    pub units: Option<Units>,
    /// What no safe net has, like weights, each with where it stands.
    pub not_safe: Vec<Diagnostic>,
    /// What is wrong with the file and changes nothing about the net.
    pub warnings: Vec<Diagnostic>,
}

impl Located {
    /// The net, if it can be safe.
    ///
    /// # Errors
    /// Weights and places with several tokens, each where it stands.
    pub fn safe(self) -> Result<Self, Vec<Diagnostic>> {
        if self.not_safe.is_empty() { Ok(self) } else { Err(self.not_safe) }
    }

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
