//! Where a run stops.

use crate::logic::{Bound, View, bind, parse_formula};
use crate::translate::System;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Source;

/// A condition at which a run stops.
#[derive(Clone, Debug)]
pub enum Breakpoint {
    /// It is about the variables at the end of a scan, and perhaps of scans before.
    Scans(Bound),
    /// It is about lines, places or transitions, too, so that each firing matters.
    Firings(Bound),
}

impl Breakpoint {
    /// Reads a condition about the end of a scan or, if it speaks of lines, places or transitions, about any marking.
    ///
    /// # Errors
    /// It is no formula, speaks of what the program does not have, or of what comes later.
    pub fn read(text: &Source, system: &System) -> Result<Self, Vec<Diagnostic>> {
        let at_end = condition(text, system, View::Scan).map(Self::Scans);
        at_end.or_else(|errors| condition(text, system, View::Transition).map(Self::Firings).map_err(|_| errors))
    }
}

/// A condition about a run so far.
///
/// # Errors
/// It is no formula, speaks of what the view does not have, or of what comes later.
pub fn condition(text: &Source, system: &System, view: View) -> Result<Bound, Vec<Diagnostic>> {
    let formula = parse_formula(text).map_err(|error| vec![error])?;
    let bound = bind(&formula, system, view)?;
    if bound.is_state_formula() {
        return Ok(bound);
    }
    let message = "a condition is about what has been, and this formula is about what comes";
    let help = "leave out the temporal operators; `petril check` is for formulas that have them";
    Err(vec![Diagnostic::new(Code::RequirementTypes, formula.span, message).help(help)])
}
