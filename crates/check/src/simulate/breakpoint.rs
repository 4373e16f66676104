//! Breakpoints: conditions at which a run stops.

use crate::requirement::bind;
use crate::translate::System;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Source;
use petril_logic::{Bound, View, parse_formula};

/// Breakpoint condition.
#[derive(Clone, Debug)]
pub enum Breakpoint {
    /// Condition on the variables at the end of a scan, possibly on earlier scans.
    Scans(Bound),
    /// Condition on lines, places or transitions, too, so that it is evaluated after each firing.
    Firings(Bound),
}

impl Breakpoint {
    /// Reads a condition on the end of a scan or, if it mentions lines, places or transitions, on any marking.
    ///
    /// # Errors
    /// The text is not a formula, mentions what the program does not have, or is about the future.
    pub fn read(text: &Source, system: &System) -> Result<Self, Vec<Diagnostic>> {
        let at_end = condition(text, system, View::Scan).map(Self::Scans);
        at_end.or_else(|errors| condition(text, system, View::Transition).map(Self::Firings).map_err(|_| errors))
    }
}

/// Reads a condition on a run so far.
///
/// # Errors
/// The text is not a formula, mentions what the view does not have, or is about the future.
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
