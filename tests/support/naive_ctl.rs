//! CTL by its textbook definition: fixpoints computed by going over all states until nothing changes.
//!
//! Shares nothing with the checker but the type of formulas. Under fairness, E G is computed after Emerson and Lei.

use petril::logic::{Bound, Quantifier};

/// A graph as lists of successors.
pub struct Kripke {
    pub successors: Vec<Vec<usize>>,
    /// States that must come again and again, if fairness is asked for.
    pub fair: Option<Vec<bool>>,
}

impl Kripke {
    /// The states that satisfy a formula; `atom` evaluates a formula about one state.
    pub fn states(&self, formula: &Bound, atom: &dyn Fn(&Bound, usize) -> bool) -> Vec<bool> {
        let n = self.successors.len();
        let of = |f: &Bound| self.states(f, atom);
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
                each(&|s| self.successors[s].iter().all(|&t| f[t]))
            }
            Bound::Next(Quantifier::Some, f) => {
                let f = of(f);
                each(&|s| self.successors[s].iter().any(|&t| f[t]))
            }
            Bound::Until { quantifier, weak, hold, release } => {
                let (f, g) = (of(hold), of(release));
                match (quantifier, weak) {
                    (Quantifier::Some, false) => self.exists_until(&f, &g),
                    (Quantifier::Some, true) => {
                        let (until, globally) = (self.exists_until(&f, &g), self.exists_globally(&f));
                        // f until a state from which f holds for ever on some fair path.
                        let on = self.exists_until(&f, &globally);
                        each(&|s| until[s] || on[s])
                    }
                    // A[f U g] = ¬(E[¬g U ¬f ∧ ¬g] ∨ E G ¬g), A[f W g] = ¬E[¬g U ¬f ∧ ¬g].
                    (Quantifier::All, weak) => {
                        let not_g = each(&|s| !g[s]);
                        let neither = each(&|s| !f[s] && !g[s]);
                        let (broken, never) = (self.exists_until(&not_g, &neither), self.exists_globally(&not_g));
                        each(&|s| !broken[s] && (*weak || !never[s]))
                    }
                }
            }
            _ => each(&|s| atom(formula, s)),
        }
    }

    fn exists_until(&self, f: &[bool], g: &[bool]) -> Vec<bool> {
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

    /// On some fair path, or some path that ends, f in all states.
    fn exists_globally(&self, f: &[bool]) -> Vec<bool> {
        let mut set = f.to_vec();
        loop {
            let goal: Vec<bool> = match &self.fair {
                None => set.clone(),
                Some(fair) => {
                    let again: Vec<bool> =
                        (0..set.len()).map(|s| set[s] && (fair[s] || self.successors[s].is_empty())).collect();
                    self.exists_until(f, &again)
                }
            };
            let next: Vec<bool> = (0..set.len())
                .map(|s| f[s] && (self.successors[s].is_empty() || self.successors[s].iter().any(|&t| goal[t])))
                .collect();
            if next == set {
                return set;
            }
            set = next;
        }
    }
}
