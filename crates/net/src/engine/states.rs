//! The states of an exploration on one thread, as packed words.

use super::exploration::Exploration;
use super::view::View;

impl Exploration {
    /// Number of words of a state.
    pub(crate) fn words(&self) -> usize {
        self.machine.packing.words()
    }

    /// Takes the words of all states, one state after another. The tables are kept.
    pub(crate) fn take_states(&mut self) -> Vec<u64> {
        let mut arena = Vec::with_capacity(self.figures.states as usize * self.words());
        self.for_each_state(|_, view| arena.extend_from_slice(view.words));
        self.shards.clear();
        self.stretches.take();
        arena
    }

    /// First state of each level, including the level found last.
    pub(crate) fn levels(&self) -> Vec<u32> {
        let Some(shard) = self.shards.first() else { return Vec::new() };
        let after = shard.level(shard.levels.len());
        let after = (!after.is_empty()).then_some(after.start);
        shard.levels.iter().copied().chain(after).map(|start| start as u32).collect()
    }

    /// Calls `look` with a state.
    pub(crate) fn show<T>(&self, words: &[u64], look: impl FnOnce(&View<'_>) -> T) -> T {
        let mut enabled = vec![0; self.machine.width];
        self.machine.enabled.put(words, &mut enabled);
        look(&View { packing: &self.machine.packing, words, enabled: &enabled })
    }

    /// Number of places of the net explored.
    pub(crate) fn places(&self) -> usize {
        self.machine.packing.places()
    }

    /// Number of tokens on a place in a state.
    pub(crate) fn tokens(&self, words: &[u64], place: usize) -> u64 {
        self.machine.packing.tokens(words, place)
    }

    /// Fires an enabled transition. Returns false and does nothing if the packing cannot hold the marking after it.
    #[must_use]
    pub(crate) fn fire(&self, transition: usize, words: &mut [u64]) -> bool {
        self.machine.fire(transition, words)
    }
}
