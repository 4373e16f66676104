//! Every state once: an arena of words, and a table of positions in it.

use std::hash::Hasher;

use hashbrown::HashTable;
use rustc_hash::FxHasher;

/// States in the order they were first seen. A state costs its words and about seven bytes of table.
pub struct Store {
    words: usize,
    len: usize,
    arena: Vec<u64>,
    index: HashTable<u32>,
}

impl Store {
    /// An empty store of states of this many words.
    pub fn new(words: usize) -> Self {
        Self { words, len: 0, arena: Vec::new(), index: HashTable::new() }
    }

    /// The words of all states, one state after another.
    pub fn into_arena(self) -> Vec<u64> {
        self.arena
    }

    /// How many states there are.
    pub fn len(&self) -> usize {
        self.len
    }

    /// A state by its number.
    pub fn get(&self, id: u32) -> &[u64] {
        let start = id as usize * self.words;
        &self.arena[start..start + self.words]
    }

    /// The number of a state, if it is there.
    pub fn find(&self, state: &[u64]) -> Option<u32> {
        self.index.find(hash(state), |&id| self.get(id) == state).copied()
    }

    /// The number of a state, new or not, and whether it is new.
    pub fn insert(&mut self, state: &[u64]) -> (u32, bool) {
        let (words, arena) = (self.words, &self.arena);
        let at = |id: u32| &arena[id as usize * words..(id as usize + 1) * words];
        let entry = self.index.entry(hash(state), |&id| at(id) == state, |&id| hash(at(id)));
        match entry {
            hashbrown::hash_table::Entry::Occupied(entry) => (*entry.get(), false),
            hashbrown::hash_table::Entry::Vacant(entry) => {
                let id = self.len as u32;
                self.len += 1;
                entry.insert(id);
                self.arena.extend_from_slice(state);
                (id, true)
            }
        }
    }

    /// Bytes in use.
    pub fn bytes(&self) -> u64 {
        (self.arena.capacity() * 8 + self.index.allocation_size()) as u64
    }
}

fn hash(state: &[u64]) -> u64 {
    let mut hasher = FxHasher::default();
    state.iter().for_each(|&word| hasher.write_u64(word));
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_state_has_one_number() {
        let mut store = Store::new(3);
        let state = |i: u64| [i % 7, i.wrapping_mul(0x9E37_79B9_7F4A_7C15), i / 7];
        for i in 0..5000 {
            assert_eq!(store.insert(&state(i)), (i as u32, true));
        }
        for i in (0..5000).rev() {
            assert_eq!(store.insert(&state(i)), (i as u32, false), "the number does not change");
            assert_eq!(store.get(i as u32), state(i));
        }
        assert_eq!(store.len(), 5000);
        assert!(store.bytes() >= 5000 * 3 * 8);
    }

    #[test]
    fn states_that_differ_in_any_bit_are_different() {
        let mut store = Store::new(2);
        assert_eq!(store.insert(&[0, 0]), (0, true));
        for bit in 0..128_usize {
            let mut state = [0_u64; 2];
            state[bit / 64] |= 1 << (bit % 64);
            assert_eq!(store.insert(&state), (bit as u32 + 1, true));
        }
    }
}
