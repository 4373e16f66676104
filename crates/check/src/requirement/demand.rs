//! Bound requirements.

use super::bind::bind;
use crate::translate::System;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_logic::{Body, Requirement};
use petril_logic::{Bound, View};

/// Bound body of a requirement.
#[derive(Clone, Debug)]
pub enum Demand {
    /// The formula must be true in every initial state.
    Formula(Bound),
    /// The formula, a possibility, must be true in some initial state: some run from power-on is a witness.
    Possible(Bound),
    /// Every line must be executed in some scan.
    EveryLine,
}

impl Demand {
    /// The formula, if there is one.
    #[must_use]
    pub fn formula(&self) -> Option<&Bound> {
        match self {
            Self::Formula(formula) | Self::Possible(formula) => Some(formula),
            Self::EveryLine => None,
        }
    }

    /// Text of the formula, or of the pattern if that differs in meaning.
    #[must_use]
    pub fn text(&self, system: &System) -> Option<String> {
        match self {
            Self::Formula(formula) => Some(formula.text(system)),
            Self::Possible(formula) => Some(match formula.possibility() {
                Some(goal) => format!("reachability({})", goal.text(system)),
                None => formula.text(system),
            }),
            Self::EveryLine => None,
        }
    }
}

/// Binds the body of a requirement.
///
/// # Errors
/// The errors of [`bind`], and bodies that the view does not support.
pub fn bind_requirement(requirement: &Requirement, system: &System, view: View) -> Result<Demand, Vec<Diagnostic>> {
    match &requirement.body {
        Body::Formula(formula) => bind(formula, system, view).map(Demand::Formula),
        Body::Possible(formula) => bind(formula, system, view).map(Demand::Possible),
        Body::EveryLine if view == View::Scan => Ok(Demand::EveryLine),
        Body::EveryLine => {
            let message = "whether every line is reachable is checked in the scan view only";
            let help = "in the transition view, ask for `EF at line 1`, `EF at line 2`, …";
            Err(vec![Diagnostic::new(Code::RequirementView, requirement.span, message).help(help)])
        }
    }
}

impl From<Bound> for Demand {
    fn from(formula: Bound) -> Self {
        Self::Formula(formula)
    }
}
