//! On which variables the value of a formula about one state rests.

use crate::logic::{Bound, Term};
use crate::semantics::VarId;

/// The variables whose values make a formula about one state true, or false: of a conjunction that is false, those of its parts
/// that are. `holds` evaluates a part. Each variable comes once, in the order of the formula.
pub fn decisive(formula: &Bound, holds: &dyn Fn(&Bound) -> bool) -> Vec<VarId> {
    let mut found = Vec::new();
    add(formula, holds, &mut found);
    found
}

fn add(formula: &Bound, holds: &dyn Fn(&Bound) -> bool, found: &mut Vec<VarId>) {
    // Of two parts, those that have the value that settles the whole; else both.
    let mut two = |f: &Bound, g: &Bound, settles: &dyn Fn(&Bound, bool) -> bool| {
        let parts = [(f, settles(f, true)), (g, settles(g, false))];
        let any = parts.iter().any(|&(_, settles)| settles);
        parts.into_iter().filter(|&(_, settles)| settles || !any).for_each(|(part, _)| add(part, holds, found));
    };
    match formula {
        Bound::Variable(variable) => push(*variable, found),
        Bound::Compare(_, left, right) => [left, right].into_iter().for_each(|term| add_term(term, holds, found)),
        Bound::Not(f) => add(f, holds, found),
        Bound::And(f, g) => two(f, g, &|part, _| !holds(part)),
        Bound::Or(f, g) => two(f, g, &|part, _| holds(part)),
        Bound::Implies(f, g) => two(f, g, &|part, is_premise| holds(part) != is_premise),
        Bound::Iff(f, g) => two(f, g, &|_, _| true),
        _ => {}
    }
}

fn add_term(term: &Term, holds: &dyn Fn(&Bound) -> bool, found: &mut Vec<VarId>) {
    match term {
        Term::Variable(variable, _) | Term::Bits { variable, .. } => push(*variable, found),
        Term::Truth(formula) => add(formula, holds, found),
        Term::Sum(a, b) | Term::Difference(a, b) | Term::Product(a, b) => {
            add_term(a, holds, found);
            add_term(b, holds, found);
        }
        Term::Number(_) | Term::Tokens(_) => {}
    }
}

fn push(variable: VarId, found: &mut Vec<VarId>) {
    if !found.contains(&variable) {
        found.push(variable);
    }
}
