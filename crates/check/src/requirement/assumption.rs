//! Assumptions about the inputs of each scan: scans that violate them are not explored.

use super::bind::bind;
use super::recalled::{Atom, looks_back_one_scan, visit};
use crate::translate::System;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_lang::semantics::Role;
use petril_logic::View;
use petril_logic::{AssumptionText, Bound};

/// A bound assumption about the inputs that a scan reads, and about the values at the end of the previous scan.
#[derive(Clone, Debug)]
pub struct Assumption {
    /// Name, if there is one.
    pub name: Option<String>,
    /// Description by the author.
    pub sentence: Option<String>,
    /// Formula as written.
    pub text: String,
    /// Bound formula about the end of the scan, when inputs still have their values from its beginning.
    pub formula: Bound,
}

/// Binds an assumption to a program.
///
/// # Errors
/// Unknown names; formulas that look ahead, or back further than one scan; and variables computed in the scan itself.
pub fn bind_assumption(text: &AssumptionText, system: &System, view: View) -> Result<Assumption, Vec<Diagnostic>> {
    let unfit =
        |message: &str, help: &str| Err(vec![Diagnostic::new(Code::AssumptionUnfit, text.span, message).help(help)]);
    if view != View::Scan {
        return unfit("assumptions about inputs are kept in the scan view only", "say the same with a plant");
    }
    let formula = bind(&text.formula, system, view)?;
    if !formula.is_state_formula() {
        return unfit("an assumption cannot look ahead", "say what inputs do in one scan, like `!(S1 & O1)`");
    }
    let mut computed = None;
    visit(&formula, false, &mut |atom| match atom {
        Atom::Now(variable) if system.program.variable(variable).role != Role::Input => {
            computed.get_or_insert(variable);
        }
        _ => {}
    });
    if let Some(variable) = computed {
        let name = &system.program.variable(variable).name;
        let message = format!("`{name}` is no input, and what a scan computes cannot be assumed");
        let help = format!("speak of the end of the scan before: `pre({name})`");
        return unfit(&message, &help);
    }
    if !looks_back_one_scan(&formula) {
        let help = "`pre(…)` of variables, and `rising`, `falling` and `changed`, look back one scan";
        return unfit("an assumption can look back one scan only", help);
    }
    let AssumptionText { name, sentence, text, .. } = text.clone();
    Ok(Assumption { name, sentence, text, formula })
}
