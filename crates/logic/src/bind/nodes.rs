//! Names in a formula about a net alone: places and transitions.

use std::collections::BTreeMap;

use super::{Name, ScanTime, Spot, Vocabulary, bind_names};
use crate::bound::{Bound, Term};
use crate::formula::{Expression, Formula};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_base::{PlaceId, TransitionId};

/// Binds the names of a formula about a net alone, where a state is a marking and a step is one firing.
///
/// # Errors
/// Every node that the net does not have, everything that only programs have, and every mixture of truth values and numbers.
pub fn bind_in_net(formula: &Formula, nodes: &Nodes<'_>) -> Result<Bound, Vec<Diagnostic>> {
    if matches!(formula.expression, Expression::Ltl(_)) {
        let message = "this formula is of LTL, which is checked on programs";
        let help = "write it in CTL, like `AG (a -> AF b)`";
        return Err(vec![Diagnostic::new(Code::RequirementView, formula.span, message).help(help)]);
    }
    bind_names(formula, nodes)
}

/// Names of a net's nodes in formulas: their own names, or their ids in the net's file.
#[derive(Clone, Debug)]
pub struct Nodes<'n> {
    places: BTreeMap<&'n str, PlaceId>,
    transitions: BTreeMap<&'n str, TransitionId>,
    by_id: bool,
}

impl<'n> Nodes<'n> {
    /// Nodes called by their names.
    pub fn by_name(
        places: impl IntoIterator<Item = (&'n str, PlaceId)>,
        transitions: impl IntoIterator<Item = (&'n str, TransitionId)>,
    ) -> Self {
        Self { by_id: false, ..Self::by_id(places, transitions) }
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

    fn inputs(&self) -> Vec<Term> {
        Vec::new()
    }

    fn outputs(&self) -> Vec<Term> {
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
