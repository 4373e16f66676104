//! Every state once: an arena of words, and a table of positions in it.

use std::hash::Hasher;

use hashbrown::HashTable;
use rustc_hash::FxHasher;

/// States in the order they were first seen. A state costs its words and about seven bytes of table.
pub struct Store {
    words: usize,
    arena: Vec<u64>,
    index: HashTable<u32>,
}

impl Store {
    /// An empty store of states of this many words.
    pub fn new(words: usize) -> Self {
        Self { words, arena: Vec::new(), index: HashTable::new() }
    }

    /// How many states there are.
    pub fn len(&self) -> usize {
        self.index.len()
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
                let id = (self.arena.len() / words) as u32;
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
