//! Requirements that hold only because their premise never does.

use super::bound::Bound;

/// The premise of an implication that the truth of a formula rests on, if `never` says that it holds in no reachable state.
///
/// Looked for are implications that every path and state comes to positively: under conjunctions, on the right of other
/// implications, and under temporal operators. The first such premise is given.
pub fn vacuous_premise<'f>(formula: &'f Bound, never: &mut dyn FnMut(&Bound) -> bool) -> Option<&'f Bound> {
    match formula {
        Bound::Implies(premise, conclusion) => {
            if never(premise) {
                Some(premise)
            } else {
                vacuous_premise(conclusion, never)
            }
        }
        Bound::And(f, g) => vacuous_premise(f, never).or_else(|| vacuous_premise(g, never)),
        Bound::Next(_, f) => vacuous_premise(f, never),
        Bound::Until { hold, release, .. } => vacuous_premise(hold, never).or_else(|| vacuous_premise(release, never)),
        _ => None,
    }
}
