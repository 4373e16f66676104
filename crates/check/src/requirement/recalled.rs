//! Formulas that look back from a moment of a scan, to the end of the previous scan.

use petril_base::VarId;
use petril_logic::{Bound, Past, Term};

/// Whether a state formula looks back to the end of the previous scan at most.
pub(super) fn looks_back_one_scan(formula: &Bound) -> bool {
    let mut deep = false;
    visit(formula, false, &mut |atom| deep |= matches!(atom, Atom::TooDeep));
    !deep
}

/// Atom of a state formula that looks back.
pub(super) enum Atom {
    /// A variable at the end of the scan.
    Now(VarId),
    /// A variable at the end of the previous scan.
    Before(VarId),
    /// An earlier value, or another term about the past.
    TooDeep,
}

/// Calls `at` with each atom; `before` says that the formula stands under `pre`.
pub(super) fn visit(formula: &Bound, before: bool, at: &mut dyn FnMut(Atom)) {
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
