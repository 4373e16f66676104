//! Selection of few tests that contain a pair for each of many conditions.

use fixedbitset::FixedBitSet;

use petril_check::simulate::Lots;

/// Number of random restarts with another order of the conditions.
const ROUNDS: usize = 24;

/// Pairs of tests for one condition: any two of the same group on different sides.
#[derive(Clone, Debug, Default)]
pub struct Pairing {
    /// Entries: test, group and side.
    entries: Vec<(usize, usize, bool)>,
    groups: usize,
}

impl Pairing {
    /// Puts a test into a group, on a side. Tests come in ascending order.
    pub fn put(&mut self, test: usize, group: usize, side: bool) {
        self.entries.push((test, group, side));
        self.groups = self.groups.max(group + 1);
    }

    /// Removes groups without pairs.
    pub fn settle(&mut self) {
        let mut sides = vec![[false; 2]; self.groups];
        self.entries.iter().for_each(|(_, group, side)| sides[*group][usize::from(*side)] = true);
        self.entries.retain(|(_, group, _)| sides[*group] == [true, true]);
    }

    /// Whether a pair exists.
    pub fn is_possible(&self) -> bool {
        !self.entries.is_empty()
    }

    /// A pair among these tests, the side FALSE first.
    pub fn pair_in(&self, tests: &[usize]) -> Option<[usize; 2]> {
        let find = |test: &usize| self.entries.binary_search_by_key(test, |(test, ..)| *test).ok();
        let here: Vec<_> = tests.iter().filter_map(find).map(|at| self.entries[at]).collect();
        let (ones, zeros): (Vec<_>, Vec<_>) = here.into_iter().partition(|(.., side)| *side);
        zeros.iter().find_map(|(zero, group, _)| {
            let one = ones.iter().find(|(_, other, _)| other == group)?;
            Some([*zero, one.0])
        })
    }

    /// The pair that adds the fewest tests; among these, the most useful one.
    fn best(&self, chosen: &FixedBitSet, use_of: &[usize]) -> Option<[usize; 2]> {
        let mut best: Vec<[Option<usize>; 2]> = vec![[None; 2]; self.groups];
        let rank = |test: usize| (chosen.contains(test), use_of[test]);
        for (test, group, side) in &self.entries {
            let place = &mut best[*group][usize::from(*side)];
            if place.is_none_or(|other| rank(*test) > rank(other)) {
                *place = Some(*test);
            }
        }
        let pairs = best.into_iter().filter_map(|[zero, one]| Some([zero?, one?]));
        let worth = |pair: &[usize; 2]| {
            let already = pair.iter().filter(|test| chosen.contains(**test)).count();
            (already, use_of[pair[0]] + use_of[pair[1]], usize::MAX - pair[0], usize::MAX - pair[1])
        };
        pairs.max_by_key(worth)
    }
}

/// Selects few of `tests` tests that contain a pair of each pairing.
pub fn select(pairings: &[Pairing], tests: usize) -> Vec<usize> {
    let mut use_of = vec![0; tests];
    pairings.iter().flat_map(|pairing| &pairing.entries).for_each(|(test, ..)| use_of[*test] += 1);
    // Conditions with few pairs come first: the others often find a pair among those tests.
    let mut order: Vec<usize> = (0..pairings.len()).collect();
    order.sort_by_key(|at| pairings[*at].entries.len());
    let mut lots = Lots::new(2);
    let mut best = once(pairings, &order, &use_of);
    let work: usize = pairings.iter().map(|pairing| pairing.entries.len()).sum();
    for _ in 0..ROUNDS.min(4_000_000 / work.max(1)) {
        for at in 1..order.len() {
            order.swap(at, lots.below(at as u128 + 1) as usize);
        }
        let found = once(pairings, &order, &use_of);
        if found.len() < best.len() {
            best = found;
        }
    }
    best
}

fn once(pairings: &[Pairing], order: &[usize], use_of: &[usize]) -> Vec<usize> {
    let mut set = FixedBitSet::with_capacity(use_of.len());
    let mut chosen: Vec<usize> = Vec::new();
    for &at in order {
        if pairings[at].pair_in(&chosen).is_none()
            && let Some(pair) = pairings[at].best(&set, use_of)
        {
            chosen.extend(pair.into_iter().filter(|test| !set.put(*test)));
        }
    }
    // Removes redundant tests.
    let mut at = 0;
    while at < chosen.len() {
        let test = chosen.remove(at);
        if !pairings.iter().all(|pairing| !pairing.is_possible() || pairing.pair_in(&chosen).is_some()) {
            chosen.insert(at, test);
            at += 1;
        }
    }
    chosen
}
