//! LTL by its textbook reduction to fair CTL (Clarke, Grumberg and Hamaguchi 1994): the product with all guesses of what the rest
//! of the path will be, in which each until that is guessed must come.
//!
//! Shares nothing with the checker but the type of formulas.

use petril::logic::Path;

use super::naive_ctl::{Fair, Kripke};

/// The operators that are left, numbered in a list so that parts come before what they are parts of.
#[derive(Clone, Copy, PartialEq)]
enum Core {
    True,
    Atom(usize),
    Not(usize),
    Or(usize, usize),
    /// There is a next state, and in it f.
    Next(usize),
    Until(usize, usize),
}

/// A formula as such a list, its own number last; atoms are numbered by `atom`.
struct List<'a, A> {
    parts: Vec<Core>,
    atom: &'a dyn Fn(&A) -> usize,
}

impl<A> List<'_, A> {
    fn put(&mut self, part: Core) -> usize {
        self.parts.iter().position(|known| *known == part).unwrap_or_else(|| {
            self.parts.push(part);
            self.parts.len() - 1
        })
    }

    fn not(&mut self, f: usize) -> usize {
        self.put(Core::Not(f))
    }

    fn and(&mut self, f: usize, g: usize) -> usize {
        let (f, g) = (self.not(f), self.not(g));
        let or = self.put(Core::Or(f, g));
        self.not(or)
    }

    /// f W g is f U g, or never ¬f.
    fn weak(&mut self, f: usize, g: usize) -> usize {
        let (all, not_f) = (self.put(Core::True), self.not(f));
        let broken = self.put(Core::Until(all, not_f));
        let (until, never) = (self.put(Core::Until(f, g)), self.not(broken));
        self.put(Core::Or(until, never))
    }

    fn add(&mut self, formula: &Path<A>) -> usize {
        let mut two = |f: &Path<A>, g: &Path<A>| (self.add(f), self.add(g));
        match formula {
            Path::State(atom) => {
                let atom = (self.atom)(atom);
                self.put(Core::Atom(atom))
            }
            Path::Not(f) => {
                let f = self.add(f);
                self.not(f)
            }
            Path::And(f, g) => {
                let (f, g) = two(f, g);
                self.and(f, g)
            }
            Path::Or(f, g) => {
                let (f, g) = two(f, g);
                self.put(Core::Or(f, g))
            }
            Path::Implies(f, g) => {
                let (f, g) = two(f, g);
                let not_f = self.not(f);
                self.put(Core::Or(not_f, g))
            }
            Path::Iff(f, g) => {
                let (f, g) = two(f, g);
                let (not_f, not_g) = (self.not(f), self.not(g));
                let (both, neither) = (self.and(f, g), self.and(not_f, not_g));
                self.put(Core::Or(both, neither))
            }
            Path::Next(f) => {
                // In the last state it is true.
                let f = self.add(f);
                let not_f = self.not(f);
                let next = self.put(Core::Next(not_f));
                self.not(next)
            }
            Path::Finally(g) => {
                let (all, g) = (self.put(Core::True), self.add(g));
                self.put(Core::Until(all, g))
            }
            Path::Globally(f) => {
                let f = self.add(f);
                let (all, not_f) = (self.put(Core::True), self.not(f));
                let broken = self.put(Core::Until(all, not_f));
                self.not(broken)
            }
            Path::Until(f, g) => {
                let (f, g) = two(f, g);
                self.put(Core::Until(f, g))
            }
            Path::WeakUntil(f, g) => {
                let (f, g) = two(f, g);
                self.weak(f, g)
            }
            Path::Release(f, g) => {
                // It is ¬(¬f U ¬g).
                let (f, g) = two(f, g);
                let (not_f, not_g) = (self.not(f), self.not(g));
                let until = self.put(Core::Until(not_f, not_g));
                self.not(until)
            }
        }
    }
}

/// The states from which a path that meets all constraints, given as masks of states, or ends, makes a formula false. Nothing if
/// this takes more than `guesses` parts to guess. `atom` numbers an atom, `truth` says where it holds.
pub fn violating<A>(
    successors: &[Vec<usize>],
    formula: &Path<A>,
    (weak, strong): (&[u64], &[(u64, u64)]),
    guesses: usize,
    atom: &dyn Fn(&A) -> usize,
    truth: &dyn Fn(usize, usize) -> bool,
) -> Option<Vec<bool>> {
    let mut list = List { parts: Vec::new(), atom };
    let root = list.add(formula);
    let parts = list.parts;
    let guessed: Vec<usize> =
        (0..parts.len()).filter(|&part| matches!(parts[part], Core::Next(_) | Core::Until(..))).collect();
    if guessed.len() > guesses {
        return None;
    }
    let combinations = 1_usize << guessed.len();
    // The truth of each part in a state, if each guessed one is true of the rest of the path as a mask says.
    let values = |state: usize, mask: usize| {
        let mut values: Vec<bool> = Vec::with_capacity(parts.len());
        for (number, part) in parts.iter().enumerate() {
            let later = || guessed.iter().position(|&g| g == number).is_some_and(|bit| mask >> bit & 1 == 1);
            values.push(match *part {
                Core::True => true,
                Core::Atom(atom) => truth(atom, state),
                Core::Not(f) => !values[f],
                Core::Or(f, g) => values[f] || values[g],
                Core::Next(_) => later(),
                Core::Until(f, g) => values[g] || (values[f] && later()),
            });
        }
        values
    };
    let n = successors.len() * combinations;
    let all: Vec<Vec<bool>> = (0..n).map(|pair| values(pair / combinations, pair % combinations)).collect();
    // What a pair asks of a step that leads to it.
    let asks = |pair: usize| {
        let holds = |&part: &usize| match parts[part] {
            Core::Next(f) => all[pair][f],
            _ => all[pair][part],
        };
        guessed.iter().enumerate().filter(|(_, part)| holds(part)).fold(0, |mask, (bit, _)| mask | 1 << bit)
    };
    let asked: Vec<usize> = (0..n).map(asks).collect();
    let steps: Vec<Vec<usize>> = (0..n)
        .map(|pair| {
            let targets = successors[pair / combinations].iter();
            let targets = targets.flat_map(|&target| (0..combinations).map(move |mask| target * combinations + mask));
            targets.filter(|&target| asked[target] == pair % combinations).collect()
        })
        .collect();
    // A path must not end where the graph goes on, or while something is still to come.
    let is_sound = |pair: usize| match successors[pair / combinations].is_empty() {
        true => pair.is_multiple_of(combinations),
        false => !steps[pair].is_empty(),
    };
    let in_set = |mask: u64| (0..n).map(|pair| mask >> (pair / combinations) & 1 == 1).collect::<Vec<bool>>();
    let mut again: Vec<Vec<bool>> = weak.iter().map(|&mask| in_set(mask)).collect();
    for (number, part) in parts.iter().enumerate() {
        if let Core::Until(_, g) = *part {
            again.push((0..n).map(|pair| !all[pair][number] || all[pair][g]).collect());
        }
    }
    // Each strong constraint is met by coming to its goal again and again, or to its premise no more.
    let mut good = vec![false; n];
    for choice in 0..1_usize << strong.len() {
        let mut sets = again.clone();
        let mut stays: Vec<bool> = (0..n).map(is_sound).collect();
        for (bit, &(premise, goal)) in strong.iter().enumerate() {
            if choice >> bit & 1 == 1 {
                sets.push(in_set(goal));
            } else {
                in_set(premise).iter().zip(&mut stays).for_each(|(premise, stays)| *stays &= !premise);
            }
        }
        let kripke = Kripke::under(Fair::Again(sets), steps.clone());
        let round = kripke.exists_globally(&stays);
        let sound: Vec<bool> = (0..n).map(is_sound).collect();
        let way = kripke.exists_until(&sound, &round);
        // A path that ends counts, whatever its last state is.
        let ends: Vec<bool> = (0..n).map(|pair| is_sound(pair) && steps[pair].is_empty()).collect();
        let end = kripke.exists_until(&sound, &ends);
        (0..n).for_each(|pair| good[pair] |= way[pair] || end[pair]);
    }
    let violating = |state: usize| {
        (0..combinations).any(|mask| {
            let pair = state * combinations + mask;
            good[pair] && !all[pair][root]
        })
    };
    Some((0..successors.len()).map(violating).collect())
}
