//! Assumptions and assertions together, as the search asks them.

use super::assertion::Assertion;
use super::assumption::Assumption;
use super::recalled::{Atom, visit};
use crate::scans::Admission;
use petril_base::VarId;
use petril_logic::{Past, Valuation};

/// Assumptions as the search's filter of scans.
pub struct Assumed<'a> {
    /// Assumptions that scans must satisfy.
    pub assumptions: &'a [Assumption],
    /// Assertions within scans; they read previous values, whether or not the program does.
    pub assertions: &'a [Assertion],
}

impl Admission for Assumed<'_> {
    fn admits(&self, before: &dyn Fn(VarId) -> u64, now: &dyn Fn(VarId) -> u64) -> bool {
        self.assumptions.iter().all(|assumption| assumption.formula.holds_in(&Moment { before, now }).unwrap_or(false))
    }

    fn recalls(&self) -> Vec<VarId> {
        let mut recalled = Vec::new();
        for assumption in self.assumptions {
            visit(&assumption.formula, false, &mut |atom| {
                if let Atom::Before(variable) = atom {
                    recalled.push(variable);
                }
            });
        }
        for assertion in self.assertions {
            visit(&assertion.formula, false, &mut |atom| {
                if let Atom::Before(variable) | Atom::Now(variable) = atom {
                    recalled.push(variable);
                }
            });
        }
        recalled
    }
}

/// A moment of a scan, for formulas that look back to the end of the previous scan at most.
pub struct Moment<'a> {
    /// Values at the end of the previous scan, or at power-on.
    pub before: &'a dyn Fn(VarId) -> u64,
    /// Current values.
    pub now: &'a dyn Fn(VarId) -> u64,
}

impl Valuation for Moment<'_> {
    fn value(&self, variable: VarId) -> u64 {
        (self.now)(variable)
    }

    fn past(&self, past: &Past) -> i128 {
        match past {
            Past::Before(term) => {
                let then = Moment { before: self.before, now: self.before };
                term.value_in(&then).unwrap_or_default()
            }
            Past::First | Past::Since(..) | Past::Run { .. } => 0,
        }
    }
}
