//! Vacuity: the premises of a requirement. If a premise is never true where it matters, the requirement holds
//! vacuously; a run in which it is true is an interesting witness.

use super::bound::Bound;
use super::formula::Quantifier;

/// Premise of an implication in a formula, with the path to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Premise<'f> {
    /// Premise.
    pub formula: &'f Bound,
    /// Conclusion of the implication.
    pub conclusion: &'f Bound,
    /// Steps from an initial state to the states where the premise matters.
    pub way: Vec<Step<'f>>,
}

/// A step on the way to a premise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step<'f> {
    /// An earlier premise is true here.
    Given(&'f Bound),
    /// To the next state.
    Next,
    /// To some state, here or later, before this formula has become true.
    Eventually(&'f Bound),
}

/// End of an until that never becomes true.
const NEVER: &Bound = &Bound::Truth(false);

/// Finds the premises of a formula, in the order of the text.
///
/// Considered are implications in positive positions: under conjunctions, on the right of other implications, and under
/// temporal operators. If a premise is unreachable, the truth of the formula does not depend on the conclusion, since
/// an implication with a false premise is true.
#[must_use]
pub fn premises(formula: &Bound) -> Vec<Premise<'_>> {
    let mut found = Vec::new();
    collect(formula, &mut Vec::new(), &mut found);
    found
}

fn collect<'f>(formula: &'f Bound, way: &mut Vec<Step<'f>>, found: &mut Vec<Premise<'f>>) {
    let mut behind = |step, part: &'f Bound, found: &mut Vec<Premise<'f>>| {
        way.push(step);
        collect(part, way, found);
        way.pop();
    };
    match formula {
        Bound::Implies(premise, conclusion) => {
            found.push(Premise { formula: premise, conclusion, way: way.clone() });
            way.push(Step::Given(premise));
            collect(conclusion, way, found);
            way.pop();
        }
        Bound::And(f, g) => {
            collect(f, way, found);
            collect(g, way, found);
        }
        Bound::Next(_, f) => behind(Step::Next, f, found),
        Bound::Until { quantifier, hold, release, .. } => {
            // Under A, `hold` matters only before `release`.
            let end = if *quantifier == Quantifier::All { release } else { NEVER };
            behind(Step::Eventually(end), hold, found);
            behind(Step::Eventually(NEVER), release, found);
        }
        _ => {}
    }
}

impl Premise<'_> {
    /// Formulas for each step of the way: the rest of the way leads from here to the premise. The last one is the
    /// premise itself.
    #[must_use]
    pub fn rests(&self) -> Vec<Bound> {
        let mut rests = vec![self.formula.clone()];
        for step in self.way.iter().rev() {
            let rest = Box::new(rests[rests.len() - 1].clone());
            rests.push(match step {
                Step::Given(premise) => Bound::And(Box::new((*premise).clone()), rest),
                Step::Next => Bound::Next(Quantifier::Some, rest),
                Step::Eventually(end) => {
                    let before = Box::new(Bound::Not(Box::new((*end).clone())));
                    let release = Box::new(Bound::And(before.clone(), rest));
                    Bound::Until { quantifier: Quantifier::Some, weak: false, hold: before, release }.simplified()
                }
            });
        }
        rests.reverse();
        rests
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use petril_base::VarId;

    fn variable(v: usize) -> Bound {
        Bound::Variable(VarId(v))
    }

    fn implies(f: &Bound, g: &Bound) -> Bound {
        Bound::Implies(Box::new(f.clone()), Box::new(g.clone()))
    }

    fn next(f: &Bound) -> Bound {
        Bound::Next(Quantifier::All, Box::new(f.clone()))
    }

    fn until(f: &Bound, g: &Bound) -> Bound {
        let (hold, release) = (Box::new(f.clone()), Box::new(g.clone()));
        Bound::Until { quantifier: Quantifier::All, weak: true, hold, release }
    }

    fn globally(f: &Bound) -> Bound {
        until(f, &Bound::Truth(false))
    }

    fn found(formula: &Bound) -> Vec<Bound> {
        premises(formula).into_iter().map(|premise| premise.formula.clone()).collect()
    }

    #[test]
    fn premises_come_in_the_order_in_which_they_stand() {
        let [a, b, c] = [0, 1, 2].map(variable);
        assert_eq!(found(&globally(&implies(&a, &b))), *std::slice::from_ref(&a));
        assert_eq!(found(&globally(&implies(&a, &implies(&b, &c)))), [a.clone(), b.clone()]);
        let both = Bound::And(Box::new(c.clone()), Box::new(globally(&implies(&b, &a))));
        assert_eq!(found(&both), *std::slice::from_ref(&b));
        assert_eq!(found(&globally(&implies(&a, &next(&implies(&b, &c))))), [a, b]);
    }

    #[test]
    fn the_way_to_a_premise_is_told() {
        let [a, b, c] = [0, 1, 2].map(variable);
        let formula = globally(&implies(&a, &next(&until(&implies(&b, &c), &a))));
        let premises = premises(&formula);
        let way = vec![Step::Eventually(NEVER), Step::Given(&a), Step::Next, Step::Eventually(&a)];
        assert_eq!(premises[1].way, way);
        let rests = premises[1].rests();
        assert_eq!(rests.len(), 5);
        assert_eq!(rests[4], b);
        let not_a = Bound::Not(Box::new(a.clone()));
        let Bound::Until { quantifier: Quantifier::Some, weak: false, hold, release } = &rests[3] else {
            unreachable!("it is an until")
        };
        assert_eq!((&**hold, &**release), (&not_a, &Bound::And(Box::new(not_a.clone()), Box::new(b))));
        assert_eq!(rests[2], Bound::Next(Quantifier::Some, Box::new(rests[3].clone())));
        assert_eq!(rests[1], Bound::And(Box::new(a), Box::new(rests[2].clone())));
    }

    #[test]
    fn what_does_not_rest_on_a_premise_is_left_alone() {
        let [a, b] = [0, 1].map(variable);
        let rest = || Box::new(implies(&a, &b));
        assert_eq!(found(&Bound::Not(rest())), []);
        assert_eq!(found(&implies(&rest(), &b)), [*rest()], "a premise of a premise is none");
        assert_eq!(found(&Bound::Or(rest(), Box::new(b.clone()))), []);
        assert_eq!(found(&Bound::Iff(rest(), Box::new(b.clone()))), []);
        assert_eq!(found(&globally(&a)), []);
    }
}
