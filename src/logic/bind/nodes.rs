//! Names in a formula about a net alone: places and transitions.

use std::collections::BTreeMap;

use super::{Name, ScanTime, Spot, Vocabulary};
use crate::diagnostic::{Code, Diagnostic};
use crate::logic::bound::{Bound, Term};
use crate::net::{Net, PlaceId, TransitionId};
use crate::semantics::Role;
use crate::source::Span;

/// Names of a net's nodes in formulas: their own names, or their ids in the net's file.
#[derive(Clone, Debug)]
pub struct Nodes<'n> {
    places: BTreeMap<&'n str, PlaceId>,
    transitions: BTreeMap<&'n str, TransitionId>,
    by_id: bool,
}

impl<'n> Nodes<'n> {
    /// Names nodes by their own names.
    #[must_use]
    pub fn by_name(net: &'n Net) -> Self {
        let places = net.place_ids().map(|place| (net.place(place).name, place));
        let transitions = net.transition_ids().map(|transition| (net.transition(transition).name, transition));
        Self { places: places.collect(), transitions: transitions.collect(), by_id: false }
    }

    /// Names nodes by the given ids. Two ids may denote the same node.
    pub fn by_id(
        places: impl IntoIterator<Item = (&'n str, PlaceId)>,
        transitions: impl IntoIterator<Item = (&'n str, TransitionId)>,
    ) -> Self {
        Self { places: places.into_iter().collect(), transitions: transitions.into_iter().collect(), by_id: true }
    }

    /// Finds places by names, given with their spans.
    ///
    /// # Errors
    /// Every unknown place.
    pub fn places<'f>(
        &self,
        names: impl IntoIterator<Item = (&'f str, Span)>,
    ) -> Result<Vec<PlaceId>, Vec<Diagnostic>> {
        let (mut places, mut errors) = (Vec::new(), Vec::new());
        for (text, span) in names {
            match self.place(&Name { text, span, errors: errors.len() }) {
                Ok(place) => places.push(place),
                Err(error) => errors.push(error),
            }
        }
        if errors.is_empty() { Ok(places) } else { Err(errors) }
    }

    /// Finds a node by name, or returns the error that there is none of its kind.
    fn find<T: Copy>(&self, kind: &str, of: &BTreeMap<&str, T>, name: &Name<'_>) -> Result<T, Diagnostic> {
        of.get(name.text).copied().ok_or_else(|| {
            let with = if self.by_id { " with the id" } else { "" };
            name.unknown(format!("the net has no {kind}{with} `{}`", name.text), of.keys().copied())
        })
    }

    /// Makes the error that a net alone has no variables.
    fn no_variable(&self, name: &Name<'_>) -> Diagnostic {
        let text = name.text;
        let help = if self.places.contains_key(text) {
            format!("to speak of the place, write `marked(\"{text}\")` or `tokens(\"{text}\")`")
        } else if self.transitions.contains_key(text) {
            format!("to speak of the transition, write `enabled(\"{text}\")`")
        } else {
            "write `marked(\"…\")` or `tokens(\"…\")` with a place, or `enabled(\"…\")` with a transition".to_owned()
        };
        only_with_program(&format!("the variable `{text}`"), name.span).help(help)
    }
}

impl Vocabulary for Nodes<'_> {
    fn truth(&self, name: &Name<'_>) -> Result<Bound, Diagnostic> {
        Err(self.no_variable(name))
    }

    fn number(&self, name: &Name<'_>) -> Result<Term, Diagnostic> {
        Err(self.no_variable(name))
    }

    fn enumerated(&self, _: &str, _: &str) -> Option<i128> {
        None
    }

    fn control(&self, _: Spot, span: Span) -> Result<Bound, Diagnostic> {
        Err(only_with_program("where control is", span))
    }

    fn place(&self, name: &Name<'_>) -> Result<PlaceId, Diagnostic> {
        self.find("place", &self.places, name)
    }

    fn transition(&self, name: &Name<'_>) -> Result<TransitionId, Diagnostic> {
        self.find("transition", &self.transitions, name)
    }

    fn scans(&self, span: Span) -> Result<ScanTime, Diagnostic> {
        Err(only_with_program("scans before or after", span))
    }

    fn all(&self, _: Role) -> Vec<Term> {
        Vec::new()
    }

    fn deadlock(&self, _: Span) -> Result<Bound, Diagnostic> {
        Ok(Bound::Deadlock)
    }
}

fn only_with_program(what: &str, span: Span) -> Diagnostic {
    let message = format!("the formula speaks of {what}, but a net alone has no program");
    Diagnostic::new(Code::RequirementView, span, message)
}
