//! Lists of transitions that may be allowed, for nets with too many transitions for rows of bits.
//!
//! Each transition is listed with one chunk, its home, at the values that allow it. So few transitions have to be
//! examined in a marking, and each of these is tested at its other chunks.

use rustc_hash::FxHashMap;

use super::conditions::{Conditions, Ranges, TABLE};
use super::packing::{Chunk, Packing};

/// For each value of each home chunk the transitions to be examined, and the tests of each transition.
pub(super) struct Candidates {
    homes: Vec<Home>,
    /// For each value of each home, the start of its list, which ends where the next one starts.
    starts: Vec<u32>,
    lists: Vec<u32>,
    /// Transitions examined in every marking.
    always: Vec<u32>,
    /// Tests of each transition, without those of its home.
    tests: Vec<Vec<Test>>,
    /// Sets of values of chunks at which a condition holds, as bits.
    sets: Vec<[u64; 4]>,
    /// Position of each set, while the tables are built.
    known: FxHashMap<[u64; 4], u32>,
}

/// A chunk at which transitions are listed.
struct Home {
    word: usize,
    shift: u32,
    mask: u64,
    /// Offset of the chunk's entries in `starts`.
    start: usize,
}

/// Test whether the value of a chunk is in a set.
struct Test {
    word: u32,
    shift: u32,
    mask: u64,
    values: Values,
}

enum Values {
    /// Values of the set at a position.
    Set(u32),
    /// Values in one of several ranges, both ends included.
    Ranges(Box<[(u64, u64)]>),
}

/// Maximum number of values of a home chunk.
const MOST_VALUES: u64 = 1 << 16;

/// Maximum number of values of a home chunk that allow a transition.
const MOST_LISTS: u64 = 256;

impl Candidates {
    /// Builds the lists and tests. If not `listed`, there are only tests, and [`Self::put`] must not be called.
    pub(super) fn of(packing: &Packing, conditions: &Conditions, listed: bool) -> Self {
        let mut all = Self {
            homes: Vec::new(),
            starts: Vec::new(),
            lists: Vec::new(),
            always: Vec::new(),
            tests: Vec::new(),
            sets: Vec::new(),
            known: FxHashMap::default(),
        };
        all.tests.resize_with(conditions.transitions, Vec::new);
        let mut homes = vec![None; conditions.transitions];
        if listed {
            homes = choose_homes(packing, conditions);
        }
        for (number, chunk) in packing.chunks.iter().enumerate() {
            let allowing = conditions.allowing(chunk);
            let (mine, others): (Vec<_>, Vec<_>) =
                allowing.into_iter().partition(|&(transition, _)| homes[transition] == Some(number));
            all.list(chunk, &mine);
            others.into_iter().for_each(|(transition, ranges)| all.test(chunk, transition, ranges));
        }
        let homeless = homes.iter().zip(0..).filter(|(home, _)| home.is_none());
        all.always = homeless.map(|(_, transition)| transition).collect();
        all.known = FxHashMap::default();
        all
    }

    /// Lists transitions with their home chunk.
    fn list(&mut self, chunk: &Chunk, transitions: &[(usize, Ranges)]) {
        if transitions.is_empty() {
            return;
        }
        let mut lists: Vec<Vec<u32>> = vec![Vec::new(); chunk.values as usize];
        for (transition, ranges) in transitions {
            let values = ranges.iter().flat_map(|&(first, last)| first..=last);
            values.for_each(|value| lists[value as usize].push(*transition as u32));
        }
        self.homes.push(Home { word: chunk.word, shift: chunk.shift, mask: chunk.mask, start: self.starts.len() });
        for list in lists {
            self.starts.push(self.lists.len() as u32);
            self.lists.extend(list);
        }
        self.starts.push(self.lists.len() as u32);
    }

    /// Adds a test of a transition at a chunk.
    fn test(&mut self, chunk: &Chunk, transition: usize, ranges: Ranges) {
        let values = if chunk.values <= TABLE {
            let mut set = [0; 4];
            let values = ranges.iter().flat_map(|&(first, last)| first..=last);
            values.for_each(|value| set[value as usize / 64] |= 1 << (value % 64));
            Values::Set(*self.known.entry(set).or_insert_with(|| {
                self.sets.push(set);
                self.sets.len() as u32 - 1
            }))
        } else {
            Values::Ranges(ranges.into())
        };
        self.tests[transition].push(Test { word: chunk.word as u32, shift: chunk.shift, mask: chunk.mask, values });
    }

    /// Writes the transitions that the marking allows into `set`.
    #[inline(never)]
    pub(super) fn put(&self, words: &[u64], set: &mut [u64]) {
        set.fill(0);
        for home in &self.homes {
            let value = words[home.word] >> home.shift & home.mask;
            let at = home.start + value as usize;
            for &transition in &self.lists[self.starts[at] as usize..self.starts[at + 1] as usize] {
                if self.tests[transition as usize].iter().all(|test| self.passes(test, words)) {
                    set[transition as usize / 64] |= 1 << (transition % 64);
                }
            }
        }
        for &transition in &self.always {
            if self.tests[transition as usize].iter().all(|test| self.passes(test, words)) {
                set[transition as usize / 64] |= 1 << (transition % 64);
            }
        }
    }

    /// Whether the marking allows all transitions of a set. Only without lists.
    #[inline(never)]
    pub(super) fn allows(&self, words: &[u64], set: &[u64]) -> bool {
        set.iter().enumerate().all(|(position, &word)| {
            let mut word = word;
            while word != 0 {
                let transition = position * 64 + word.trailing_zeros() as usize;
                word &= word - 1;
                if !self.tests[transition].iter().all(|test| self.passes(test, words)) {
                    return false;
                }
            }
            true
        })
    }

    #[inline(always)]
    fn passes(&self, test: &Test, words: &[u64]) -> bool {
        let value = words[test.word as usize] >> test.shift & test.mask;
        match &test.values {
            Values::Set(set) => self.sets[*set as usize][value as usize / 64 % 4] >> (value % 64) & 1 == 1,
            Values::Ranges(ranges) => ranges.iter().any(|&(first, last)| first <= value && value <= last),
        }
    }

    /// Memory in use, in bytes.
    pub(super) fn bytes(&self) -> u64 {
        let tests: usize = self.tests.iter().map(|tests| tests.capacity() * size_of::<Test>()).sum();
        ((self.starts.capacity() + self.lists.capacity()) * 4 + self.sets.capacity() * 32 + tests) as u64
    }
}

/// Home chunk of each transition: the one that allows it at the smallest fraction of its values.
fn choose_homes(packing: &Packing, conditions: &Conditions) -> Vec<Option<usize>> {
    let mut best: Vec<Option<(f64, usize)>> = vec![None; conditions.transitions];
    for (number, chunk) in packing.chunks.iter().enumerate().filter(|(_, chunk)| chunk.values <= MOST_VALUES) {
        for (transition, ranges) in conditions.allowing(chunk) {
            let values: u64 = ranges.iter().map(|(first, last)| last - first + 1).sum();
            let part = values as f64 / chunk.values as f64;
            if values <= MOST_LISTS && best[transition].is_none_or(|(least, _)| part < least) {
                best[transition] = Some((part, number));
            }
        }
    }
    best.into_iter().map(|best| best.map(|(_, chunk)| chunk)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::cover::Bounds;
    use super::super::model::{Arcs, Model};
    use super::super::rows::Rows;
    use super::*;

    /// Net with many places, counters and pairs of places, and pseudo-random transitions.
    fn model(transitions: u64) -> Model {
        let mut seed = 1_u64;
        let mut next = |below: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) % below
        };
        let mut model = Model { initial: vec![0; 330], transitions: Vec::new() };
        (model.initial[0], model.initial[300], model.initial[301], model.initial[302]) = (1, 700, 9, 1);
        for _ in 0..transitions {
            let mut arcs = Arcs::default();
            if next(4) > 0 {
                arcs.pre.push((next(300) as u32, 1));
                arcs.post.push((next(300) as u32, 1));
            }
            for _ in 0..next(3) {
                // 300 and 301 exchange their tokens with 303 and 304; of each pair of later places at most one is
                // marked.
                let (from, to, weight) = match next(4) {
                    0 => (300, 303, 1 + next(400)),
                    1 => (304, 301, 1 + next(3)),
                    2 => (301, 304, 1 + next(3)),
                    _ => (302 + 3 * next(9), 305 + 3 * next(8), 1),
                };
                arcs.pre.push((from as u32, weight));
                arcs.post.push((to as u32, weight));
            }
            model.transitions.push(arcs);
        }
        model
    }

    #[test]
    fn candidates_say_what_rows_say() {
        let model = model(500);
        let rules = model.rules().unwrap();
        let bounds = Bounds::of(&model.initial, &rules);
        let packing = Packing::of(bounds.digits(&vec![1; 330]), 330);
        assert!(
            packing.chunks.iter().any(|chunk| chunk.values > TABLE && chunk.digits[0].1.content.places().len() > 1)
        );
        assert!(
            packing.chunks.iter().any(|chunk| chunk.values > TABLE && chunk.digits[0].1.content.places().len() == 1)
        );
        let conditions = [Conditions::enabling(&packing, &rules), Conditions::fitting(&packing, &rules, &bounds)];
        for conditions in conditions {
            let rows = Rows::of(&packing, &conditions, 8);
            let candidates = Candidates::of(&packing, &conditions, true);
            let tests = Candidates::of(&packing, &conditions, false);
            for sample in 0..2000_u64 {
                let mut words = vec![0; packing.words()];
                for (number, chunk) in packing.chunks.iter().enumerate() {
                    let value = (sample + number as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 20;
                    words[chunk.word] |= (value % chunk.values) << chunk.shift;
                }
                let (mut expected, mut found) = ([0; 8], [0; 8]);
                rows.put(&words, &mut expected);
                candidates.put(&words, &mut found);
                assert_eq!(found, expected);
                assert!(tests.allows(&words, &expected));
                let forbidden = (0..500).find(|t| expected[t / 64] >> (t % 64) & 1 == 0);
                if let Some(transition) = forbidden {
                    expected[transition / 64] |= 1 << (transition % 64);
                    assert!(!tests.allows(&words, &expected) && !rows.allows(&words, &expected));
                }
            }
        }
    }
}
