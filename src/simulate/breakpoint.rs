//! Where a run stops.

use super::session::Session;
use crate::diagnostic::{Code, Diagnostic};
use crate::logic::{Bound, Valuation, View, bind, parse_formula};
use crate::net::{PlaceId, TransitionId};
use crate::semantics::VarId;
use crate::source::Source;
use crate::translate::System;

/// A condition at which a run stops.
#[derive(Clone, Debug)]
pub enum Breakpoint {
    /// It is about the variables at the end of a scan.
    Scans(Bound),
    /// It is about lines, places or transitions, too, so that each firing matters.
    Firings(Bound),
}

impl Breakpoint {
    /// Reads a condition about the end of a scan.
    ///
    /// # Errors
    /// It is no formula, speaks of what the program does not have, or of more than one state.
    pub fn at_end(text: &Source, system: &System) -> Result<Self, Vec<Diagnostic>> {
        condition(text, system, View::Scan).map(Self::Scans)
    }

    /// Reads a condition about the end of a scan or, if it speaks of lines, places or transitions, about any marking.
    ///
    /// # Errors
    /// As [`Breakpoint::at_end`].
    pub fn anywhere(text: &Source, system: &System) -> Result<Self, Vec<Diagnostic>> {
        Self::at_end(text, system)
            .or_else(|errors| condition(text, system, View::Transition).map(Self::Firings).map_err(|_| errors))
    }

    /// Whether a session is at it.
    #[must_use]
    pub fn is_met(&self, session: &Session<'_>) -> bool {
        match self {
            Self::Scans(condition) => !session.is_within() && holds(condition, &session.state().memory),
            Self::Firings(condition) => session.replay().holds(condition) == Some(true),
        }
    }

    /// Whether values of all variables meet it.
    #[must_use]
    pub fn is_met_by(&self, memory: &[u64]) -> bool {
        matches!(self, Self::Scans(condition) if holds(condition, memory))
    }
}

fn condition(text: &Source, system: &System, view: View) -> Result<Bound, Vec<Diagnostic>> {
    let formula = parse_formula("condition", text).map_err(|error| vec![error])?.formula;
    let bound = bind(&formula, system, view)?;
    if bound.is_state_formula() {
        return Ok(bound);
    }
    let message = "a condition is about one state, and this formula is about paths";
    let help = "leave out the temporal operators; `petril check` is for formulas that have them";
    Err(vec![Diagnostic::new(Code::RequirementTypes, formula.span, message).help(help)])
}

fn holds(condition: &Bound, memory: &[u64]) -> bool {
    condition.holds_in(&Values(memory)) == Some(true)
}

/// The values of all variables. Conditions bound for the scan view speak of nothing else.
struct Values<'a>(&'a [u64]);

impl Valuation for Values<'_> {
    fn value(&self, variable: VarId) -> u64 {
        self.0[variable.0]
    }

    fn is_marked(&self, _: PlaceId) -> bool {
        false
    }

    fn tokens(&self, _: PlaceId) -> u64 {
        0
    }

    fn is_enabled(&self, _: TransitionId) -> bool {
        false
    }

    fn is_deadlock(&self) -> bool {
        false
    }
}
