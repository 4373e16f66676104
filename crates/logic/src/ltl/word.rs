//! Evaluation of LTL on a given path, directly by the definition, to check counterexamples.

use super::formula::Path;

impl<A> Path<A> {
    /// Whether the formula holds on the path through positions 0 to `len - 1`, the last of which steps back to
    /// `loop_start`, or is the end of the path if that is `None`. `atom` says whether an atom holds at a position.
    pub fn holds_on(&self, len: usize, loop_start: Option<usize>, atom: &dyn Fn(&A, usize) -> bool) -> bool {
        Lasso { len, loop_start, atom }.positions(self).first().copied().unwrap_or(false)
    }
}

struct Lasso<'a, A> {
    len: usize,
    loop_start: Option<usize>,
    atom: &'a dyn Fn(&A, usize) -> bool,
}

impl<A> Lasso<'_, A> {
    fn next(&self, position: usize) -> Option<usize> {
        if position + 1 < self.len { Some(position + 1) } else { self.loop_start }
    }

    /// Evaluates a formula at every position.
    fn positions(&self, formula: &Path<A>) -> Vec<bool> {
        let each = |value: &dyn Fn(usize) -> bool| (0..self.len).map(value).collect::<Vec<bool>>();
        let all = |value| vec![value; self.len];
        let two = |f: &Path<A>, g: &Path<A>| (self.positions(f), self.positions(g));
        match formula {
            Path::State(f) => each(&|i| (self.atom)(f, i)),
            Path::Not(f) => self.positions(f).into_iter().map(|holds| !holds).collect(),
            Path::And(f, g) => {
                let (f, g) = two(f, g);
                each(&|i| f[i] && g[i])
            }
            Path::Or(f, g) => {
                let (f, g) = two(f, g);
                each(&|i| f[i] || g[i])
            }
            Path::Implies(f, g) => {
                let (f, g) = two(f, g);
                each(&|i| !f[i] || g[i])
            }
            Path::Iff(f, g) => {
                let (f, g) = two(f, g);
                each(&|i| f[i] == g[i])
            }
            Path::Next(f) => {
                let f = self.positions(f);
                each(&|i| self.next(i).is_none_or(|next| f[next]))
            }
            Path::Finally(g) => self.until(&all(true), &self.positions(g), false),
            Path::Globally(f) => self.until(&self.positions(f), &all(false), true),
            Path::Until(f, g) => self.until(&self.positions(f), &self.positions(g), false),
            Path::WeakUntil(f, g) => self.until(&self.positions(f), &self.positions(g), true),
            Path::Release(f, g) => {
                let (f, g) = two(f, g);
                self.until(&g, &each(&|i| f[i] && g[i]), true)
            }
        }
    }

    /// Evaluates f U g, or f W g if `weak`, at every position. Two passes reach the fixpoint.
    fn until(&self, f: &[bool], g: &[bool], weak: bool) -> Vec<bool> {
        let mut holds = vec![weak; self.len];
        for position in (0..self.len).rev().chain((0..self.len).rev()) {
            let later = self.next(position).map_or(weak, |next| holds[next]);
            holds[position] = g[position] || (f[position] && later);
        }
        holds
    }
}
