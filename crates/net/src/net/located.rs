//! A net together with the positions of its nodes in the file it was read from.

use super::{Net, PlaceId, TransitionId, Units};
use petril_base::diagnostic::Diagnostic;
use petril_base::source::Span;

/// A net read from a text, so that diagnostics can point at its nodes.
#[derive(Clone, Debug)]
pub struct Located {
    /// The net.
    pub net: Net,
    /// Definition of each place in the text, or its first use where the format needs no definition.
    pub places: Vec<Span>,
    /// Definition of each transition in the text.
    pub transitions: Vec<Span>,
    /// Places that are used and not declared, where the format needs no declaration.
    pub undeclared: Vec<PlaceId>,
    /// Ids of places and transitions in the file, by position; none where the format has names only.
    pub ids: Option<(Vec<String>, Vec<String>)>,
    /// Units of the places (NUPN), if the file has them.
    pub units: Option<Units>,
    /// Errors for whatever a safe net cannot have, such as weights.
    pub not_safe: Vec<Diagnostic>,
    /// Faults of the file that do not change the net.
    pub warnings: Vec<Diagnostic>,
}

impl Located {
    /// Returns the net if it can be safe.
    ///
    /// # Errors
    /// Weights and places with several tokens, each with its position.
    pub fn safe(self) -> Result<Self, Vec<Diagnostic>> {
        if self.not_safe.is_empty() { Ok(self) } else { Err(self.not_safe) }
    }

    /// Position of a place in the text.
    #[must_use]
    pub fn place_span(&self, place: PlaceId) -> Span {
        self.places[place.index()]
    }

    /// Position of a transition in the text.
    #[must_use]
    pub fn transition_span(&self, transition: TransitionId) -> Span {
        self.transitions[transition.index()]
    }
}
