//! Decisive literals: the parts that determine the value of a state formula.

use petril_lang::semantics::VarId;
use petril_logic::{Bound, Comparison, Past, Term};

/// Literal that the value of a formula depends on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Literal {
    /// Current value of a variable.
    Now(VarId),
    /// Value of a variable one scan earlier.
    Before(VarId),
    /// Past-time term, as a formula that is true or false.
    Past(Bound),
}

/// Decisive literals of a state formula: of a false conjunction, those of its false parts. `holds` evaluates a part.
/// Each literal occurs once, in the order of the formula.
pub fn decisive(formula: &Bound, holds: &dyn Fn(&Bound) -> bool) -> Vec<Literal> {
    let mut found = Vec::new();
    add(formula, holds, &mut found);
    found
}

fn add(formula: &Bound, holds: &dyn Fn(&Bound) -> bool, found: &mut Vec<Literal>) {
    // The operands that settle the value alone, if any; else both.
    let mut two = |f: &Bound, g: &Bound, settles: &dyn Fn(&Bound, bool) -> bool| {
        let parts = [(f, settles(f, true)), (g, settles(g, false))];
        let any = parts.iter().any(|&(_, settles)| settles);
        parts.into_iter().filter(|&(_, settles)| settles || !any).for_each(|(part, _)| add(part, holds, found));
    };
    match formula {
        Bound::Variable(variable) | Bound::Bit(variable, _) => push(Literal::Now(*variable), found),
        Bound::Compare(_, left, right) => [left, right].into_iter().for_each(|term| add_term(term, holds, found)),
        Bound::Not(f) => add(f, holds, found),
        Bound::And(f, g) => two(f, g, &|part, _| !holds(part)),
        Bound::Or(f, g) => two(f, g, &|part, _| holds(part)),
        Bound::Implies(f, g) => two(f, g, &|part, is_premise| holds(part) != is_premise),
        Bound::Iff(f, g) => two(f, g, &|_, _| true),
        _ => {}
    }
}

fn add_term(term: &Term, holds: &dyn Fn(&Bound) -> bool, found: &mut Vec<Literal>) {
    match term {
        Term::Variable(variable, _) | Term::Bits { variable, .. } => push(Literal::Now(*variable), found),
        Term::Truth(formula) => add(formula, holds, found),
        Term::Sum(a, b) | Term::Difference(a, b) | Term::Product(a, b) => {
            add_term(a, holds, found);
            add_term(b, holds, found);
        }
        Term::Past(past) => match (&**past, before(past)) {
            (_, Some(variable)) => push(Literal::Before(variable), found),
            (Past::Run { most, .. }, None) => {
                let whole = Term::Number(i128::from(*most));
                push(Literal::Past(Bound::Compare(Comparison::AtLeast, term.clone(), whole)), found);
            }
            (past, None) if past.is_truth() => {
                push(Literal::Past(Bound::Compare(Comparison::Unequal, term.clone(), Term::Number(0))), found);
            }
            _ => {}
        },
        Term::Number(_) | Term::Tokens(_) => {}
    }
}

/// Variable whose value one scan earlier a past term denotes.
fn before(past: &Past) -> Option<VarId> {
    match past {
        Past::Before(Term::Variable(variable, _)) => Some(*variable),
        Past::Before(Term::Truth(formula)) => match **formula {
            Bound::Variable(variable) => Some(variable),
            _ => None,
        },
        _ => None,
    }
}

fn push(literal: Literal, found: &mut Vec<Literal>) {
    if !found.contains(&literal) {
        found.push(literal);
    }
}
