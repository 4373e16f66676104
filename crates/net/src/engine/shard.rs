//! A shard: the states owned by one thread.

use std::ops::Range;

use super::fold::Fold;
use super::keys::Keys;
use super::machine::{Changes, Machine};
use super::search::Wanted;
use super::stubborn::{self, Stubborn};
use super::tally::Seen;
use super::view::View;

/// A shard of the states. The shard of a state is a hash of its marking.
pub(super) struct Shard {
    number: usize,
    seen_keys: Keys,
    /// Tree compression, for markings of several words.
    fold: Option<Fold>,
    /// Numbers of bits of the left and of the right half of a compressed key.
    halves: (u32, u32),
    /// Keys of states in the order in which they were found, level by level. If states are not kept, expanded ones of
    /// earlier levels are missing.
    states: Vec<u64>,
    /// Parent edges: the transition by which each state was first reached; the number of transitions for the initial
    /// state.
    vias: Vec<u32>,
    /// The first state not yet expanded, and (`end`) the end of its level.
    next: usize,
    end: usize,
    pub(super) levels: Vec<usize>,
    pub(super) counts: Counts,
    pub(super) seen: Seen,
    /// Memory that this shard may use, in bytes.
    share: u64,
    /// Whether there was no room for a state, which is missing.
    is_full: bool,
    scratch: Scratch,
}

/// Counts of a shard.
#[derive(Clone, Debug, Default)]
pub(super) struct Counts {
    pub(super) expanded: u64,
    pub(super) transitions: u64,
    pub(super) deadlocks: u64,
    /// Number of transitions fired; the others were known to lead to no new state.
    pub(super) fired: u64,
    /// The smallest of the nearest deadlocks, with its distance.
    pub(super) deadlock: Option<(usize, Vec<u64>)>,
}

/// Message of states found to the shard that owns them: their words and the transitions that lead to them.
#[derive(Default)]
pub(super) struct Letter {
    pub(super) words: Vec<u64>,
    pub(super) vias: Vec<u32>,
}

/// Reason why the expansion of states ended early.
pub(super) enum Halt {
    /// A transition enabled in this marking makes a digit overflow.
    Overflow(Vec<u64>),
    /// The wanted marking was found.
    Found(Vec<u64>),
}

/// Reusable memory.
#[derive(Default)]
struct Scratch {
    keys: Vec<u64>,
    vias: Vec<u32>,
    set: Vec<u64>,
    words: Vec<u64>,
    after: Vec<u64>,
    numbers: Vec<u32>,
    numbers_after: Vec<u32>,
    stubborn: stubborn::Scratch,
}

/// Parameters of a search.
pub(super) struct Task<'a> {
    pub(super) machine: &'a Machine,
    /// Predicate that ends the search at a state.
    pub(super) wanted: Option<&'a dyn Wanted>,
    /// Stubborn sets for a goal, if there is one.
    pub(super) stubborn: Option<&'a Stubborn<'a>>,
    pub(super) shards: usize,
    /// Whether states are kept.
    pub(super) keep: bool,
}

/// Number of states found before they are inserted together.
const TOGETHER: usize = 1024;

impl Shard {
    /// Makes an empty shard, which may use `share` bytes.
    pub(super) fn new(number: usize, machine: &Machine, share: u64) -> Self {
        let words = machine.packing.words();
        let fold = (words > 1).then(|| Fold::new(words));
        let halves = (8, 8);
        let bits = if fold.is_some() { 16 } else { machine.packing.bits[0].max(1) };
        let nodes = fold.as_ref().map_or(0, Fold::nodes);
        Self {
            number,
            seen_keys: Keys::new(bits),
            fold,
            halves,
            states: Vec::new(),
            vias: Vec::new(),
            next: 0,
            end: 0,
            levels: Vec::new(),
            counts: Counts::default(),
            seen: machine.meter.nothing(machine.width),
            share,
            is_full: false,
            scratch: Scratch {
                set: vec![0; machine.width],
                words: vec![0; words],
                after: vec![0; words],
                numbers: vec![0; nodes],
                numbers_after: vec![0; nodes],
                ..Scratch::default()
            },
        }
    }

    /// Number of states.
    pub(super) fn len(&self) -> usize {
        self.seen_keys.len()
    }

    /// Number of kept states that were expanded; these come first.
    pub(super) fn expanded(&self) -> usize {
        self.next
    }

    /// Whether there was no room for a state.
    pub(super) fn is_full(&self) -> bool {
        self.is_full
    }

    /// Number of states of the current level that are not yet expanded.
    pub(super) fn waiting(&self) -> usize {
        self.end - self.next
    }

    /// Memory in use in bytes, which is also the peak so far.
    pub(super) fn bytes(&self) -> u64 {
        let states = self.states.capacity() * 8 + self.vias.capacity() * 4;
        self.seen_keys.bytes() + states as u64 + self.fold.as_ref().map_or(0, Fold::bytes)
    }

    /// Begins the next level: the states found since the last call.
    pub(super) fn begin_level(&mut self, keep: bool) {
        if !keep {
            self.states.drain(..self.end);
            self.vias.drain(..self.end);
            (self.next, self.end) = (0, 0);
        }
        self.levels.push(self.next);
        self.end = self.states.len();
    }

    /// Inserts states found by other shards.
    pub(super) fn receive(&mut self, letter: &Letter) {
        if let Some(fold) = &mut self.fold {
            let numbers = &mut self.scratch.numbers_after;
            let keys = letter.words.chunks_exact(self.scratch.words.len()).map(|words| fold.key(words, numbers));
            self.scratch.keys.extend(keys);
        } else {
            self.scratch.keys.extend_from_slice(&letter.words);
        }
        self.scratch.vias.extend_from_slice(&letter.vias);
        self.enter();
    }

    /// Expands up to `most` states of the current level.
    pub(super) fn expand(&mut self, most: usize, task: &Task<'_>, letters: &mut [Letter]) -> Option<Halt> {
        let single = self.fold.is_none();
        match (task.machine.width, single) {
            (1, true) => self.expand_with::<1, true>(most, task, letters),
            (2, true) => self.expand_with::<2, true>(most, task, letters),
            (4, true) => self.expand_with::<4, true>(most, task, letters),
            (6, true) => self.expand_with::<6, true>(most, task, letters),
            (8, true) => self.expand_with::<8, true>(most, task, letters),
            (_, true) => self.expand_with::<0, true>(most, task, letters),
            (2, false) => self.expand_with::<2, false>(most, task, letters),
            (4, false) => self.expand_with::<4, false>(most, task, letters),
            (8, false) => self.expand_with::<8, false>(most, task, letters),
            (_, false) => self.expand_with::<0, false>(most, task, letters),
        }
    }

    /// Expands states. `WIDTH` is the width of sets of transitions, or 0 if unknown at compile time; `SINGLE` means
    /// that a marking is one word and its own key.
    fn expand_with<const WIDTH: usize, const SINGLE: bool>(
        &mut self,
        most: usize,
        task: &Task<'_>,
        letters: &mut [Letter],
    ) -> Option<Halt> {
        let machine = task.machine;
        let mut several = std::mem::take(&mut self.scratch.words);
        let mut one = [0; 1];
        let mut many = std::mem::take(&mut self.scratch.set);
        let mut few = [0; WIDTH];
        let mut halt = None;
        for _ in 0..most.min(self.waiting()) {
            let (key, via) = (self.states[self.next], self.vias[self.next]);
            let words: &mut [u64] = if SINGLE { &mut one } else { &mut several };
            if let Some(fold) = self.fold.as_mut().filter(|_| !SINGLE) {
                fold.unfold(key, words, &mut self.scratch.numbers);
            } else {
                words[0] = key;
            }
            let set: &mut [u64] = if WIDTH == 0 { &mut many } else { &mut few };
            machine.enabled.put(words, set);
            if machine.fits.as_ref().is_some_and(|fits| !fits.allows(words, set)) {
                halt = Some(Halt::Overflow(words.to_vec()));
                break;
            }
            self.next += 1;
            machine.meter.note(words, set, &mut self.seen);
            let enabled: u32 = set.iter().map(|word| word.count_ones()).sum();
            self.counts.transitions += u64::from(enabled);
            self.counts.expanded += 1;
            if enabled == 0 {
                self.counts.deadlock(self.levels.len(), words);
            }
            if task.wanted.is_some_and(|wanted| wanted.is(&View { packing: &machine.packing, words, enabled: set })) {
                halt = Some(Halt::Found(words.to_vec()));
                break;
            }
            match task.stubborn {
                Some(stubborn) => stubborn.restrict(&machine.packing, words, set, &mut self.scratch.stubborn),
                None => machine.swaps.restrict(via, set),
            }
            for (position, word) in set.iter().enumerate() {
                let mut word = *word;
                while word != 0 {
                    let transition = position * 64 + word.trailing_zeros() as usize;
                    word &= word - 1;
                    debug_assert!(machine.fits(transition, words), "a digit is too small");
                    if SINGLE {
                        let after = words[0].wrapping_add(machine.change[transition]);
                        self.found_single(after, transition as u32, task, letters);
                    } else {
                        self.found(words, transition, task, letters);
                    }
                }
            }
            if self.scratch.keys.len() >= TOGETHER {
                self.enter();
            }
        }
        self.scratch.words = several;
        self.scratch.set = many;
        self.enter();
        halt
    }

    #[inline(always)]
    fn found_single(&mut self, after: u64, via: u32, task: &Task<'_>, letters: &mut [Letter]) {
        if task.shards > 1 {
            let owner = owner(&[after], task.shards);
            if owner != self.number {
                letters[owner].words.push(after);
                letters[owner].vias.push(via);
                return;
            }
        }
        self.scratch.keys.push(after);
        self.scratch.vias.push(via);
    }

    fn found(&mut self, words: &[u64], transition: usize, task: &Task<'_>, letters: &mut [Letter]) {
        let changes = &task.machine.changes[transition];
        if task.shards > 1 {
            self.scratch.after.copy_from_slice(words);
            for &(word, change) in &changes.words {
                self.scratch.after[word] = words[word].wrapping_add(change);
            }
            let owner = owner(&self.scratch.after, task.shards);
            if owner != self.number {
                letters[owner].words.extend_from_slice(&self.scratch.after);
                letters[owner].vias.push(transition as u32);
                return;
            }
        }
        let Some(fold) = &mut self.fold else { return };
        let numbers = &mut self.scratch.numbers_after;
        numbers.copy_from_slice(&self.scratch.numbers);
        for &(word, change) in &changes.words {
            fold.leaf(word, words[word].wrapping_add(change), numbers);
        }
        changes.above.iter().for_each(|&node| fold.inner(node, numbers));
        self.scratch.keys.push(fold.root(numbers));
        self.scratch.vias.push(transition as u32);
    }

    /// Inserts the collected keys, and appends the new ones to the states.
    fn enter(&mut self) {
        let beside = self.bytes() - self.seen_keys.bytes();
        self.seen_keys.grow_within(self.share.saturating_sub(beside));
        let (keys, vias) = (&mut self.scratch.keys, &mut self.scratch.vias);
        self.is_full |= self.states.try_reserve(keys.len()).is_err() || self.vias.try_reserve(keys.len()).is_err();
        if self.is_full {
            keys.clear();
            vias.clear();
            return;
        }
        self.counts.fired += keys.len() as u64;
        let (states, reached) = (&mut self.states, &mut self.vias);
        if let Some(fold) = &self.fold {
            let (left, right) = fold.numbers();
            let old = self.halves;
            if left >> old.0 > 0 || right >> old.1 > 0 {
                let bits =
                    |numbers: usize, old: u32| if numbers >> old > 0 { numbers.ilog2() + 2 } else { old }.min(32);
                let new = (bits(left, old.0), bits(right, old.1));
                if self.seen_keys.widen(new.0 + new.1, |key| narrow(wide(key, old), new)) {
                    self.halves = new;
                } else {
                    self.is_full = true;
                    keys.clear();
                    vias.clear();
                    return;
                }
            }
            let halves = self.halves;
            keys.iter_mut().for_each(|key| *key = narrow(*key, halves));
            self.is_full = !self.seen_keys.insert(keys, |at| {
                states.push(wide(keys[at], halves));
                reached.push(vias[at]);
            });
        } else {
            self.is_full = !self.seen_keys.insert(keys, |at| {
                states.push(keys[at]);
                reached.push(vias[at]);
            });
        }
        keys.clear();
        vias.clear();
    }

    /// Positions of the kept states at a distance.
    pub(super) fn level(&self, distance: usize) -> Range<usize> {
        let bound = |distance| self.levels.get(distance).copied().unwrap_or(self.end_of_level(distance));
        bound(distance)..bound(distance + 1)
    }

    /// End of the level before the one at `distance`, which was not begun.
    fn end_of_level(&self, distance: usize) -> usize {
        if distance == self.levels.len() { self.end } else { self.states.len() }
    }

    /// Transition by which a state at a distance was first reached, if this shard has kept the state.
    pub(super) fn via(&self, words: &[u64], distance: usize) -> Option<u32> {
        let key = self.fold.as_ref().map_or(Some(words[0]), |fold| fold.find(words))?;
        let level = self.level(distance);
        let at = level.start + self.states[level].iter().position(|&state| state == key)?;
        Some(self.vias[at])
    }

    /// Memory for the numbers of the compression-tree nodes.
    pub(super) fn numbers(&self) -> Vec<u32> {
        vec![0; self.fold.as_ref().map_or(0, Fold::nodes)]
    }

    /// Decodes the marking of a kept state.
    pub(super) fn unpack(&self, position: usize, words: &mut [u64], numbers: &mut [u32]) {
        match &self.fold {
            Some(fold) => fold.unfold(self.states[position], words, numbers),
            None => words[0] = self.states[position],
        }
    }

    /// Number of bits of a key.
    pub(super) fn bits(&self) -> u32 {
        self.seen_keys.bits()
    }

    /// Finds the key of a marking, if all its parts have numbers.
    pub(super) fn key(&self, words: &[u64]) -> Option<u64> {
        self.fold.as_ref().map_or(Some(words[0]), |fold| fold.find(words).and_then(|key| self.narrowed(key)))
    }

    /// Finds the key of the marking after a firing in a marking of this shard with these node numbers, if all its parts
    /// have numbers. `room` is reusable memory.
    pub(super) fn key_after(
        &self,
        words: &[u64],
        changes: Option<&Changes>,
        numbers: &[u32],
        room: &mut Vec<u32>,
    ) -> Option<u64> {
        let (Some(fold), Some(changes)) = (&self.fold, changes) else { return Some(words[0]) };
        room.clear();
        room.extend_from_slice(numbers);
        fold.find_after(words, changes, room).and_then(|key| self.narrowed(key))
    }

    /// Narrow form of a key; `None` if a half has too many bits, which can happen when there was no more room to widen
    /// keys.
    fn narrowed(&self, key: u64) -> Option<u64> {
        let narrow = narrow(key, self.halves);
        (wide(narrow, self.halves) == key).then_some(narrow)
    }

    /// Narrow key of a kept state.
    pub(super) fn narrow_key(&self, position: usize) -> u64 {
        let key = self.states[position];
        if self.fold.is_some() { narrow(key, self.halves) } else { key }
    }
}

impl Counts {
    fn deadlock(&mut self, distance: usize, words: &[u64]) {
        self.deadlocks += 1;
        match &mut self.deadlock {
            Some((nearest, least)) if *nearest == distance && words < &least[..] => least.copy_from_slice(words),
            Some(_) => {}
            None => self.deadlock = Some((distance, words.to_vec())),
        }
    }
}

/// Number of the shard that owns a marking.
#[inline(always)]
pub(super) fn owner(words: &[u64], shards: usize) -> usize {
    let mix = |hash: u64, word: &u64| (hash ^ word ^ word >> 31).wrapping_mul(0xA076_1D64_78BD_642F).rotate_left(23);
    (words.iter().fold(0, mix) >> 32) as usize % shards
}

/// Narrow form of a key: both halves without the unused bits between them.
#[inline(always)]
fn narrow(key: u64, (left, _): (u32, u32)) -> u64 {
    key & 0xFFFF_FFFF | key >> 32 << left
}

/// Wide form of a narrow key: both halves with 32 bits each.
#[inline(always)]
fn wide(key: u64, (left, _): (u32, u32)) -> u64 {
    key & !(u64::MAX << left) | key >> left << 32
}
