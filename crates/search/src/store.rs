//! Store of distinct states: an arena of words, and a hash table of numbers.

use std::hint::black_box;

use crate::table::Table;

/// Distinct states in the order in which they were first seen. A state takes its words and about seven bytes of table.
pub struct Store {
    words: usize,
    len: usize,
    arena: Vec<u64>,
    table: Table,
}

/// Number of states inserted together. Their lines fit into the innermost cache.
const BATCH: usize = 64;

impl Store {
    /// Makes an empty store of states of `words` words.
    pub fn new(words: usize) -> Self {
        Self { words, len: 0, arena: Vec::new(), table: Table::default() }
    }

    /// Returns the words of all states, one state after another.
    pub fn into_arena(self) -> Vec<u64> {
        self.arena
    }

    /// Number of states.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Words of a state.
    pub fn get(&self, id: u32) -> &[u64] {
        let start = id as usize * self.words;
        &self.arena[start..start + self.words]
    }

    /// Inserts consecutive states, and appends their numbers, new or not.
    pub fn enter(&mut self, states: &[u64], numbers: &mut Vec<u32>) {
        for states in states.chunks(BATCH * self.words) {
            let (words, arena) = (self.words, &self.arena);
            let at = |id: u32| &arena[id as usize * words..(id as usize + 1) * words];
            self.table.reserve(BATCH, |id| hash(at(id).iter().copied()));
            let mut hashes = [0; BATCH];
            let mut touched = 0;
            // The loads in these loops are independent, so many of them overlap.
            for (hashed, state) in hashes.iter_mut().zip(states.chunks_exact(words)) {
                *hashed = hash(state.iter().copied());
                touched ^= self.table.touch(*hashed);
            }
            for (&hashed, _) in hashes.iter().zip(states.chunks_exact(words)) {
                touched ^= self.table.candidate(hashed).map_or(0, |id| at(id)[0] as u32);
            }
            black_box(touched);
            for (&hashed, state) in hashes.iter().zip(states.chunks_exact(words)) {
                let arena = &self.arena;
                let is = |id: u32| arena[id as usize * words..(id as usize + 1) * words] == *state;
                let next = self.len as u32;
                let id = self.table.enter(hashed, next, is);
                if id == next {
                    self.len += 1;
                    self.arena.extend_from_slice(state);
                }
                numbers.push(id);
            }
        }
    }

    /// Memory in bytes, beside that in use, for inserting `more` states: of the table, which is rebuilt, and of the list.
    pub fn growth(&self, more: usize) -> (u64, u64) {
        (self.table.growth(more + BATCH), growth(&self.arena, more.saturating_mul(self.words)))
    }

    /// Memory in use, in bytes.
    pub fn bytes(&self) -> u64 {
        self.arena.capacity() as u64 * 8 + self.table.bytes()
    }
}

/// Memory in bytes that a list takes when it grows by `more` items; 0 if it need not grow.
pub fn growth<T>(list: &Vec<T>, more: usize) -> u64 {
    let len = list.len().saturating_add(more);
    let grown = if len > list.capacity() { len.max(list.capacity().saturating_mul(2)) } else { 0 };
    (grown as u64).saturating_mul(size_of::<T>() as u64)
}

/// Hash of words, by folded 128-bit products.
#[inline(always)]
pub fn hash(words: impl Iterator<Item = u64>) -> u64 {
    words.fold(0x9E37_79B9_7F4A_7C15, |hash: u64, word| {
        let product = u128::from(hash ^ word) * 0xA076_1D64_78BD_642F;
        product as u64 ^ (product >> 64) as u64
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn enter(store: &mut Store, states: &[u64]) -> Vec<u32> {
        let mut numbers = Vec::new();
        store.enter(states, &mut numbers);
        numbers
    }

    #[test]
    fn every_state_has_one_number() {
        let mut store = Store::new(3);
        let state = |i: u64| [i % 7, i.wrapping_mul(0x9E37_79B9_7F4A_7C15), i / 7];
        let states: Vec<u64> = (0..5000).flat_map(state).collect();
        assert_eq!(enter(&mut store, &states), (0..5000).collect::<Vec<u32>>());
        for i in (0..5000).rev() {
            assert_eq!(enter(&mut store, &state(i)), [i as u32], "the number does not change");
            assert_eq!(store.get(i as u32), state(i));
        }
        assert_eq!(store.len(), 5000);
        assert!(store.bytes() >= 5000 * 3 * 8);
        let twice = [state(6000), state(3), state(6000)].concat();
        assert_eq!(enter(&mut store, &twice), [5000, 3, 5000]);
    }

    #[test]
    fn growth_is_known_beforehand() {
        let mut store = Store::new(2);
        let (mut tables, mut lists) = (0, 0);
        for first in (0..100_000_u64).step_by(500) {
            let (table, list) = store.growth(500);
            let (table_before, list_before) = (store.table.bytes(), store.arena.capacity());
            enter(&mut store, &(first..first + 500).flat_map(|i| [i, 7]).collect::<Vec<_>>());
            if store.table.bytes() > table_before {
                assert_eq!(store.table.bytes(), table);
                tables += 1;
            }
            let bytes = store.arena.capacity() as u64 * 8;
            assert_eq!(store.arena.capacity() > list_before, list > 0);
            assert!(list == 0 || (list..=2 * list).contains(&bytes), "{list} {bytes}");
            lists += usize::from(list > 0);
        }
        // From 448 numbers to 114,688 the table becomes larger eight times, and the list from 1000 words to 256,000 as often.
        assert_eq!((tables, lists), (8, 9));
    }

    #[test]
    fn states_that_differ_in_any_bit_are_different() {
        let mut store = Store::new(2);
        assert_eq!(enter(&mut store, &[0, 0]), [0]);
        for bit in 0..128_usize {
            let mut state = [0_u64; 2];
            state[bit / 64] |= 1 << (bit % 64);
            assert_eq!(enter(&mut store, &state), [bit as u32 + 1]);
        }
    }
}
