//! The premises of a requirement: the cases about which it says something. If one never occurs where it is asked about, the
//! requirement holds without saying anything; a run in which it occurs is an example of what it is about.

use super::bound::Bound;
use super::formula::Quantifier;

/// The premise of an implication that the truth of a formula rests on, and the way there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Premise<'f> {
    /// The premise.
    pub formula: &'f Bound,
    /// What follows from it.
    pub conclusion: &'f Bound,
    /// The way to the places where it is asked about, from an initial state.
    pub way: Vec<Step<'f>>,
}

/// A part of the way to a premise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step<'f> {
    /// An earlier premise holds here.
    Given(&'f Bound),
    /// Then the next state.
    Next,
    /// Then some state: here or later, before this formula has become true.
    Eventually(&'f Bound),
}

/// What is before nothing: an end that never comes.
const NEVER: &Bound = &Bound::Truth(false);

/// The premises, in the order in which they stand.
///
/// Looked for are implications that every path and state comes to positively: under conjunctions, on the right of other
/// implications, and under temporal operators. Where no way leads to a premise, the truth of the formula does not depend on what
/// follows from it: an implication whose premise is false is true.
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
            // On all paths, what is to hold until the release matters only before it.
            let end = if *quantifier == Quantifier::All { release } else { NEVER };
            behind(Step::Eventually(end), hold, found);
            behind(Step::Eventually(NEVER), release, found);
        }
        _ => {}
    }
}

impl Premise<'_> {
    /// For each part of the way, that the rest of it can be gone from here and leads to the premise; last, the premise itself.
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
    use petril_lang::semantics::VarId;

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
