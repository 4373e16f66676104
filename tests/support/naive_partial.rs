//! CTL on a part of the markings of a net, in three values, by the definitions: for each formula, the markings where it surely
//! holds, and those where it possibly does, whatever the markings not seen are like.

use std::collections::BTreeMap;

use petril::explore::engine::Model;
use petril::logic::{Bound, Quantifier, Valuation};
use petril::net::{PlaceId, TransitionId};
use petril::semantics::VarId;

use super::naive_nets::{Marking, fire};

/// A part of the reachability graph.
pub struct Partial<'m> {
    model: &'m Model,
    /// The initial marking is the first.
    pub markings: Vec<Marking>,
    /// The successors of each marking, if they were looked for.
    successors: Vec<Option<Vec<usize>>>,
}

/// Where a formula surely holds, and where it possibly does.
#[derive(Clone)]
struct Truth {
    surely: Vec<bool>,
    possibly: Vec<bool>,
}

/// A marking as formulas about one state see it.
pub struct At<'n>(pub &'n Model, pub &'n Marking);

impl Valuation for At<'_> {
    fn value(&self, _: VarId) -> u64 {
        unreachable!()
    }
    fn is_marked(&self, place: PlaceId) -> bool {
        self.tokens(place) > 0
    }
    fn tokens(&self, place: PlaceId) -> u64 {
        self.1[place.index()]
    }
    fn is_enabled(&self, transition: TransitionId) -> bool {
        fire(&self.0.transitions[transition.index()], self.1).is_some()
    }
    fn is_deadlock(&self) -> bool {
        (0..self.0.transitions.len()).all(|transition| !self.is_enabled(TransitionId::at(transition)))
    }
}

impl<'m> Partial<'m> {
    /// The successors of all markings up to a distance from the initial one, unless there are more than `most` markings.
    pub fn of(model: &'m Model, distance: usize, most: usize) -> Self {
        let mut numbers: BTreeMap<Marking, usize> = [(model.initial.clone(), 0)].into();
        let mut partial = Self { model, markings: vec![model.initial.clone()], successors: Vec::new() };
        let (mut level, mut end) = (0, 1);
        while partial.successors.len() < partial.markings.len() && partial.markings.len() <= most {
            let number = partial.successors.len();
            if number == end {
                (level, end) = (level + 1, partial.markings.len());
            }
            if level > distance {
                break;
            }
            let after: Vec<Marking> =
                model.transitions.iter().filter_map(|arcs| fire(arcs, &partial.markings[number])).collect();
            let mut known = |marking: Marking| {
                *numbers.entry(marking).or_insert_with_key(|marking| {
                    partial.markings.push(marking.clone());
                    partial.markings.len() - 1
                })
            };
            partial.successors.push(Some(after.into_iter().map(&mut known).collect()));
        }
        partial.successors.resize(partial.markings.len(), None);
        partial
    }

    /// Whether every marking has been seen.
    pub fn is_complete(&self) -> bool {
        self.successors.iter().all(Option::is_some)
    }

    /// Whether a formula holds at the beginning, if this part tells.
    pub fn answer(&self, formula: &Bound) -> Option<bool> {
        let truth = self.truth(formula);
        match (truth.surely[0], truth.possibly[0]) {
            (true, false) => unreachable!(),
            (surely, possibly) => (surely == possibly).then_some(surely),
        }
    }

    fn truth(&self, formula: &Bound) -> Truth {
        let n = self.markings.len();
        let each = |value: &dyn Fn(usize) -> bool| (0..n).map(value).collect::<Vec<bool>>();
        let two = |f: &Bound, g: &Bound| (self.truth(f), self.truth(g));
        match formula {
            Bound::Not(f) => {
                let f = self.truth(f);
                Truth { surely: each(&|s| !f.possibly[s]), possibly: each(&|s| !f.surely[s]) }
            }
            Bound::And(f, g) => {
                let (f, g) = two(f, g);
                let and = |f: &[bool], g: &[bool]| each(&|s| f[s] && g[s]);
                Truth { surely: and(&f.surely, &g.surely), possibly: and(&f.possibly, &g.possibly) }
            }
            Bound::Or(f, g) => {
                let (f, g) = two(f, g);
                let or = |f: &[bool], g: &[bool]| each(&|s| f[s] || g[s]);
                Truth { surely: or(&f.surely, &g.surely), possibly: or(&f.possibly, &g.possibly) }
            }
            Bound::Implies(f, g) => self.truth(&Bound::Or(Box::new(Bound::Not(f.clone())), g.clone())),
            Bound::Iff(f, g) => {
                let both = Bound::And(
                    Box::new(Bound::Implies(f.clone(), g.clone())),
                    Box::new(Bound::Implies(g.clone(), f.clone())),
                );
                self.truth(&both)
            }
            Bound::Next(quantifier, f) => {
                let f = self.truth(f);
                Truth {
                    surely: each(&|s| self.step(s, *quantifier, false, &f.surely, true)),
                    possibly: each(&|s| self.step(s, *quantifier, true, &f.possibly, true)),
                }
            }
            Bound::Until { quantifier, weak, hold, release } => {
                let (f, g) = two(hold, release);
                Truth {
                    surely: self.until(*quantifier, *weak, false, &f.surely, &g.surely),
                    possibly: self.until(*quantifier, *weak, true, &f.possibly, &g.possibly),
                }
            }
            _ => {
                let holds = each(&|s| formula.holds_in(&At(self.model, &self.markings[s])).unwrap());
                Truth { surely: holds.clone(), possibly: holds }
            }
        }
    }

    /// Whether some step, or every one, leads to a set. Of a marking whose steps are not known, `unknown`; where there are none,
    /// some leads nowhere, and every one anywhere, unless `ends` is not enough.
    fn step(&self, marking: usize, quantifier: Quantifier, unknown: bool, set: &[bool], ends: bool) -> bool {
        match (&self.successors[marking], quantifier) {
            (None, _) => unknown,
            (Some(next), Quantifier::Some) => next.iter().any(|&next| set[next]),
            (Some(next), Quantifier::All) => next.iter().all(|&next| set[next]) && (ends || !next.is_empty()),
        }
    }

    /// The least set, or the greatest for a weak until, that has what it must have.
    fn until(&self, quantifier: Quantifier, weak: bool, unknown: bool, f: &[bool], g: &[bool]) -> Vec<bool> {
        let mut set = vec![weak; f.len()];
        loop {
            let mut changed = false;
            for s in (0..set.len()).rev() {
                let ends = weak && self.successors[s].as_ref().is_some_and(Vec::is_empty);
                let now = g[s] || f[s] && (ends || self.step(s, quantifier, unknown, &set, weak));
                changed |= now != set[s];
                set[s] = now;
            }
            if !changed {
                return set;
            }
        }
    }
}
