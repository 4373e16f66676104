//! CTL by its textbook definition: fixpoints computed by going over all states until nothing changes.
//!
//! Shares nothing with the checker but the type of formulas. With one set of fair states, E G is computed after Emerson and Lei;
//! with any constraints, by trying every set of states that a path can come to again and again.

use petril::logic::{Bound, Quantifier};

/// A graph as lists of successors.
pub struct Kripke {
    successors: Vec<Vec<usize>>,
    fair: Fair,
    /// The states from which a path counts.
    counting: Vec<bool>,
}

/// Which infinite paths count.
pub enum Fair {
    All,
    /// Those that come to each of these sets again and again.
    Again(Vec<Vec<bool>>),
    /// Those whose states that come again and again are exactly one of these sets, each a mask of bits.
    Rounds(Vec<u64>),
}

/// The sets of states that a path can come to again and again, and to no others, so that it comes to each set of `weak`, and for
/// each pair of `strong` to the second if to the first: all subsets are tried.
pub fn rounds(successors: &[Vec<usize>], weak: &[u64], strong: &[(u64, u64)]) -> Vec<u64> {
    let next: Vec<u64> = successors.iter().map(|next| next.iter().fold(0, |mask, &t| mask | 1 << t)).collect();
    let meets = |set: u64| {
        weak.iter().all(|goal| set & goal != 0)
            && strong.iter().all(|(premise, goal)| set & premise == 0 || set & goal != 0)
    };
    (1_u64..1 << successors.len()).filter(|&set| meets(set) && is_round(&next, set)).collect()
}

/// Whether from each state of a set some steps, at least one, lead to each of its states without leaving it.
fn is_round(next: &[u64], set: u64) -> bool {
    let members = || (0..next.len()).filter(|&s| set >> s & 1 == 1);
    members().all(|from| {
        let mut reached = next[from] & set;
        loop {
            let more = members().filter(|&s| reached >> s & 1 == 1).fold(reached, |all, s| all | next[s] & set);
            if more == reached {
                return reached == set;
            }
            reached = more;
        }
    })
}

impl Kripke {
    /// A graph all of whose paths count.
    pub fn new(successors: Vec<Vec<usize>>) -> Self {
        let counting = vec![true; successors.len()];
        Self { successors, fair: Fair::All, counting }
    }

    /// A graph in which only some paths count.
    pub fn under(fair: Fair, successors: Vec<Vec<usize>>) -> Self {
        let mut kripke = Self { fair, ..Self::new(successors) };
        kripke.counting = kripke.exists_globally(&kripke.counting);
        kripke
    }

    /// The states from which a path counts.
    pub fn counting(&self) -> &[bool] {
        &self.counting
    }

    /// The states that satisfy a formula; `atom` evaluates a formula about one state.
    pub fn states(&self, formula: &Bound, atom: &dyn Fn(&Bound, usize) -> bool) -> Vec<bool> {
        let n = self.successors.len();
        let of = |f: &Bound| self.states(f, atom);
        let counting = self.counting();
        // Where a path comes to, it must go on with one that counts.
        let and_counts = |f: Vec<bool>| f.into_iter().zip(counting).map(|(f, &counts)| f && counts).collect::<Vec<_>>();
        let each = |value: &dyn Fn(usize) -> bool| (0..n).map(value).collect::<Vec<bool>>();
        match formula {
            Bound::Not(f) => of(f).into_iter().map(|x| !x).collect(),
            Bound::And(f, g) => {
                let (f, g) = (of(f), of(g));
                each(&|s| f[s] && g[s])
            }
            Bound::Or(f, g) => {
                let (f, g) = (of(f), of(g));
                each(&|s| f[s] || g[s])
            }
            Bound::Implies(f, g) => {
                let (f, g) = (of(f), of(g));
                each(&|s| !f[s] || g[s])
            }
            Bound::Iff(f, g) => {
                let (f, g) = (of(f), of(g));
                each(&|s| f[s] == g[s])
            }
            Bound::Next(Quantifier::All, f) => {
                let f = of(f);
                each(&|s| self.successors[s].iter().all(|&t| f[t] || !counting[t]))
            }
            Bound::Next(Quantifier::Some, f) => {
                let f = and_counts(of(f));
                each(&|s| self.successors[s].iter().any(|&t| f[t]))
            }
            Bound::Until { quantifier, weak, hold, release } => {
                let (f, g) = (of(hold), of(release));
                match (quantifier, weak) {
                    (Quantifier::Some, false) => self.exists_until(&f, &and_counts(g)),
                    (Quantifier::Some, true) => {
                        let (until, globally) = (self.exists_until(&f, &and_counts(g)), self.exists_globally(&f));
                        // f until a state from which f holds for ever on some fair path.
                        let on = self.exists_until(&f, &globally);
                        each(&|s| until[s] || on[s])
                    }
                    // A[f U g] = ¬(E[¬g U ¬f ∧ ¬g] ∨ E G ¬g), A[f W g] = ¬E[¬g U ¬f ∧ ¬g].
                    (Quantifier::All, weak) => {
                        let not_g = each(&|s| !g[s]);
                        let neither = and_counts(each(&|s| !f[s] && !g[s]));
                        let (broken, never) = (self.exists_until(&not_g, &neither), self.exists_globally(&not_g));
                        each(&|s| !broken[s] && (*weak || !never[s]))
                    }
                }
            }
            _ => each(&|s| atom(formula, s)),
        }
    }

    pub fn exists_until(&self, f: &[bool], g: &[bool]) -> Vec<bool> {
        let mut set = g.to_vec();
        loop {
            let next: Vec<bool> =
                (0..set.len()).map(|s| g[s] || (f[s] && self.successors[s].iter().any(|&t| set[t]))).collect();
            if next == set {
                return set;
            }
            set = next;
        }
    }

    /// On some path that counts, f in all states.
    pub fn exists_globally(&self, f: &[bool]) -> Vec<bool> {
        if let Fair::Rounds(rounds) = &self.fair {
            let inside = |set: u64| (0..f.len()).all(|s| set >> s & 1 == 0 || f[s]);
            let good = rounds.iter().filter(|&&set| inside(set)).fold(0, |all, set| all | set);
            let goal: Vec<bool> =
                (0..f.len()).map(|s| good >> s & 1 == 1 || (f[s] && self.successors[s].is_empty())).collect();
            return self.exists_until(f, &goal);
        }
        let everywhere = vec![vec![true; f.len()]];
        let sets =
            if let Fair::Again(sets) = &self.fair { [sets.as_slice(), &everywhere].concat() } else { everywhere };
        let mut set = f.to_vec();
        loop {
            let mut next = set.clone();
            for again in &sets {
                let here: Vec<bool> =
                    (0..set.len()).map(|s| set[s] && (again[s] || self.successors[s].is_empty())).collect();
                let goal = self.exists_until(f, &here);
                for (next, successors) in next.iter_mut().zip(&self.successors) {
                    *next &= successors.is_empty() || successors.iter().any(|&t| goal[t]);
                }
            }
            if next == set {
                return set;
            }
            set = next;
        }
    }
}
