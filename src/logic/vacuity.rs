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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::logic::Quantifier;
    use crate::semantics::VarId;

    fn variable(v: usize) -> Bound {
        Bound::Variable(VarId(v))
    }

    fn implies(f: Bound, g: Bound) -> Bound {
        Bound::Implies(Box::new(f), Box::new(g))
    }

    fn globally(f: Bound) -> Bound {
        let (hold, release) = (Box::new(f), Box::new(Bound::Truth(false)));
        Bound::Until { quantifier: Quantifier::All, weak: true, hold, release }
    }

    /// The premise found if these variables, and what is an implication, hold nowhere.
    fn found(formula: &Bound, never: &[usize]) -> Option<Bound> {
        vacuous_premise(formula, &mut |f| never.iter().any(|&v| *f == variable(v))).cloned()
    }

    #[test]
    fn the_premise_that_never_holds_is_found() {
        let [a, b, c] = [0, 1, 2].map(variable);
        assert_eq!(found(&globally(implies(a.clone(), b.clone())), &[0]), Some(a.clone()));
        assert_eq!(found(&globally(implies(a.clone(), b.clone())), &[1]), None, "a conclusion may be false");
        let chain = globally(implies(a.clone(), implies(b.clone(), c.clone())));
        assert_eq!(found(&chain, &[1]), Some(b.clone()));
        assert_eq!(found(&chain, &[0, 1]), Some(a.clone()), "the first one");
        let both = Bound::And(Box::new(c.clone()), Box::new(globally(implies(b.clone(), a.clone()))));
        assert_eq!(found(&both, &[1]), Some(b.clone()));
        let next = globally(implies(a, Bound::Next(Quantifier::All, Box::new(implies(b.clone(), c)))));
        assert_eq!(found(&next, &[1]), Some(b));
    }

    #[test]
    fn what_does_not_rest_on_a_premise_is_left_alone() {
        let [a, b] = [0, 1].map(variable);
        let rest = || Box::new(implies(a.clone(), b.clone()));
        assert_eq!(found(&Bound::Not(rest()), &[0]), None);
        assert_eq!(found(&implies(*rest(), b.clone()), &[0]), None, "a premise of a premise");
        assert_eq!(found(&Bound::Or(rest(), Box::new(b.clone())), &[0]), None);
        assert_eq!(found(&Bound::Iff(rest(), Box::new(b.clone())), &[0]), None);
        assert_eq!(found(&globally(a.clone()), &[0]), None);
    }
}
