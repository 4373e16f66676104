//! A formula about one state as the goal of a search.

use crate::explore::Goal;
use crate::logic::{Bound, Comparison, Term};

/// Parts a goal may have. Equivalences multiply them.
const MOST_PARTS: usize = 10_000;

/// The goal that the formula is true, or that it is false. Nothing if the formula is temporal, speaks of variables, or is not
/// linear.
pub(super) fn aim(formula: &Bound, truth: bool) -> Option<Goal> {
    let mut left = MOST_PARTS;
    goal(formula, truth, &mut left)
}

fn goal(formula: &Bound, truth: bool, left: &mut usize) -> Option<Goal> {
    *left = left.checked_sub(1)?;
    let mut parts = |f, g, truth_of_f, truth_of_g| Some(vec![goal(f, truth_of_f, left)?, goal(g, truth_of_g, left)?]);
    let join = |all: bool, parts| if all { Goal::All(parts) } else { Goal::Any(parts) };
    Some(match formula {
        Bound::Truth(value) => Goal::Truth(*value == truth),
        Bound::Marked(place) if truth => Goal::AtLeast { terms: vec![(place.index() as u32, 1)], least: 1 },
        Bound::Marked(place) => Goal::AtLeast { terms: vec![(place.index() as u32, -1)], least: 0 },
        Bound::Enabled(transition) if truth => Goal::Enabled(transition.index() as u32),
        Bound::Enabled(transition) => Goal::Disabled(transition.index() as u32),
        Bound::Deadlock => [Goal::Alive, Goal::Dead][usize::from(truth)].clone(),
        Bound::Compare(comparison, a, b) => {
            compare(if truth { *comparison } else { opposite(*comparison) }, Linear::difference(a, b)?)?
        }
        Bound::Not(f) => goal(f, !truth, left)?,
        Bound::And(f, g) => join(truth, parts(f, g, truth, truth)?),
        Bound::Or(f, g) => join(!truth, parts(f, g, truth, truth)?),
        Bound::Implies(f, g) => join(!truth, parts(f, g, !truth, truth)?),
        Bound::Iff(f, g) => {
            Goal::Any(vec![Goal::All(parts(f, g, true, truth)?), Goal::All(parts(f, g, false, !truth)?)])
        }
        Bound::Variable(_) | Bound::Next(..) | Bound::Until { .. } => return None,
    })
}

/// The goal that a sum compares so with 0.
fn compare(comparison: Comparison, sum: Linear) -> Option<Goal> {
    let Linear { terms, number } = sum;
    let least = |more: i128| Some(Goal::AtLeast { terms: terms.clone(), least: more.checked_sub(number)? });
    let most = |less: i128| {
        let terms: Option<Vec<(u32, i64)>> =
            terms.iter().map(|&(p, factor)| Some((p, factor.checked_neg()?))).collect();
        Some(Goal::AtLeast { terms: terms?, least: number.checked_sub(less)? })
    };
    Some(match comparison {
        Comparison::AtLeast => least(0)?,
        Comparison::Greater => least(1)?,
        Comparison::AtMost => most(0)?,
        Comparison::Less => most(-1)?,
        Comparison::Equal => Goal::All(vec![least(0)?, most(0)?]),
        Comparison::Unequal => Goal::Any(vec![least(1)?, most(-1)?]),
    })
}

fn opposite(comparison: Comparison) -> Comparison {
    match comparison {
        Comparison::Equal => Comparison::Unequal,
        Comparison::Unequal => Comparison::Equal,
        Comparison::Less => Comparison::AtLeast,
        Comparison::AtMost => Comparison::Greater,
        Comparison::Greater => Comparison::AtMost,
        Comparison::AtLeast => Comparison::Less,
    }
}

/// Tokens of places times numbers, and a number. The places ascend, and no factor is 0.
struct Linear {
    terms: Vec<(u32, i64)>,
    number: i128,
}

impl Linear {
    /// One term minus another.
    fn difference(a: &Term, b: &Term) -> Option<Self> {
        let mut sum = Self { terms: Vec::new(), number: 0 };
        sum.add(a, 1)?;
        sum.add(b, -1)?;
        sum.terms.sort_unstable_by_key(|&(place, _)| place);
        let mut merged: Vec<(u32, i64)> = Vec::with_capacity(sum.terms.len());
        for (place, factor) in sum.terms {
            match merged.last_mut() {
                Some((last, sum)) if *last == place => *sum = sum.checked_add(factor)?,
                _ => merged.push((place, factor)),
            }
        }
        merged.retain(|&(_, factor)| factor != 0);
        Some(Self { terms: merged, number: sum.number })
    }

    fn add(&mut self, term: &Term, factor: i64) -> Option<()> {
        match term {
            Term::Number(number) => {
                self.number = self.number.checked_add(number.checked_mul(factor.into())?)?;
            }
            Term::Tokens(place) => self.terms.push((place.index() as u32, factor)),
            Term::Sum(a, b) => {
                self.add(a, factor)?;
                self.add(b, factor)?;
            }
            Term::Difference(a, b) => {
                self.add(a, factor)?;
                self.add(b, factor.checked_neg()?)?;
            }
            Term::Product(a, b) => {
                let (constant, other) = constant(a).map(|a| (a, b)).or_else(|| Some((constant(b)?, a)))?;
                self.add(other, factor.checked_mul(i64::try_from(constant).ok()?)?)?;
            }
            Term::Variable(..) | Term::Bits { .. } | Term::Truth(_) => return None,
        }
        Some(())
    }
}

/// The number that a term is in every state, if it has no places at all.
fn constant(term: &Term) -> Option<i128> {
    let mut sum = Linear { terms: Vec::new(), number: 0 };
    sum.add(term, 1)?;
    sum.terms.is_empty().then_some(sum.number)
}
