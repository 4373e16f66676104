//! Formulas about a program to bound formulas.

use petril_base::diagnostic::Diagnostic;
use petril_logic::{Bound, Formula, View, bind_names};

use super::program::InProgram;
use crate::translate::System;

/// Binds the names of a formula about a program.
///
/// # Errors
/// Every name that means nothing in this view, and every mixture of truth values and numbers.
pub fn bind(formula: &Formula, system: &System, view: View) -> Result<Bound, Vec<Diagnostic>> {
    bind_names(formula, &InProgram { system, view })
}
