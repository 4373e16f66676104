//! Translation of a state formula into a goal of a reachability search.

use super::linear::Linear;
use crate::Goal;
use petril_logic::{Bound, Comparison};

/// Upper bound on the size of a goal. Equivalences duplicate their operands.
const MOST_PARTS: usize = 10_000;

/// Translates "the formula is true" (or false) into a goal; `None` if the formula is temporal, mentions variables, or
/// is not linear.
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
        Bound::Variable(_) | Bound::Bit(..) | Bound::Next(..) | Bound::Until { .. } | Bound::Ltl(_) => return None,
    })
}

/// The goal that a linear term compares with 0 in this way.
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
