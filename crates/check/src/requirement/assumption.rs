//! Assumptions about the inputs of each scan: scans that violate them are not explored.

use super::assertion::Assertion;
use super::bind::bind;
use crate::scans::Admission;
use crate::translate::System;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_lang::semantics::{Role, VarId};
use petril_logic::AssumptionText;
use petril_logic::Past;
use petril_logic::View;
use petril_logic::{Bound, Term, Valuation};

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

/// Whether a state formula looks back to the end of the previous scan at most.
pub(super) fn looks_back_one_scan(formula: &Bound) -> bool {
    let mut deep = false;
    visit(formula, false, &mut |atom| deep |= matches!(atom, Atom::TooDeep));
    !deep
}

/// Atom of an assumption.
enum Atom {
    /// A variable at the end of the scan.
    Now(VarId),
    /// A variable at the end of the previous scan.
    Before(VarId),
    /// An earlier value, or another term about the past.
    TooDeep,
}

fn visit(formula: &Bound, before: bool, at: &mut dyn FnMut(Atom)) {
    let atom = |variable| if before { Atom::Before(variable) } else { Atom::Now(variable) };
    match formula {
        Bound::Variable(variable) | Bound::Bit(variable, _) => at(atom(*variable)),
        Bound::Compare(_, a, b) => {
            visit_term(a, before, at);
            visit_term(b, before, at);
        }
        Bound::Not(f) | Bound::Next(_, f) => visit(f, before, at),
        Bound::And(f, g)
        | Bound::Or(f, g)
        | Bound::Implies(f, g)
        | Bound::Iff(f, g)
        | Bound::Until { hold: f, release: g, .. } => {
            visit(f, before, at);
            visit(g, before, at);
        }
        Bound::Ltl(path) => path.atoms().into_iter().for_each(|atom| visit(atom, before, at)),
        Bound::Truth(_) | Bound::Marked(_) | Bound::Enabled(_) | Bound::Deadlock => {}
    }
}

fn visit_term(term: &Term, before: bool, at: &mut dyn FnMut(Atom)) {
    match term {
        Term::Variable(variable, _) => at(if before { Atom::Before(*variable) } else { Atom::Now(*variable) }),
        Term::Truth(f) => visit(f, before, at),
        Term::Sum(a, b) | Term::Difference(a, b) | Term::Product(a, b) => {
            visit_term(a, before, at);
            visit_term(b, before, at);
        }
        Term::Past(past) => match &**past {
            Past::Before(term) if !before => visit_term(term, true, at),
            _ => at(Atom::TooDeep),
        },
        Term::Number(_) | Term::Bits { .. } | Term::Tokens(_) => {}
    }
}

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
