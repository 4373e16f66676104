//! A state as it is passed to callbacks of a search.

use super::packing::Packing;

/// A marking and its enabled transitions.
pub struct View<'a> {
    pub(super) packing: &'a Packing,
    pub(super) words: &'a [u64],
    pub(super) enabled: &'a [u64],
}

impl View<'_> {
    /// Number of tokens on a place.
    #[must_use]
    pub fn tokens(&self, place: usize) -> u64 {
        self.packing.tokens(self.words, place)
    }

    /// Number of tokens on every place.
    #[must_use]
    pub fn marking(&self) -> Vec<u64> {
        (0..self.packing.places()).map(|place| self.tokens(place)).collect()
    }

    /// Whether a transition is enabled.
    #[must_use]
    pub fn is_enabled(&self, transition: usize) -> bool {
        self.enabled[transition / 64] >> (transition % 64) & 1 == 1
    }

    /// The enabled transitions, ascending.
    pub fn enabled(&self) -> impl Iterator<Item = usize> {
        let bits = |word: u64| std::iter::successors(Some(word), |word| Some(word & word.wrapping_sub(1)));
        let transitions = move |(position, &word): (usize, &u64)| {
            let left = bits(word).take_while(|&word| word != 0);
            left.map(move |word| position * 64 + word.trailing_zeros() as usize)
        };
        self.enabled.iter().enumerate().flat_map(transitions)
    }

    /// Whether no transition is enabled.
    #[must_use]
    pub fn is_deadlock(&self) -> bool {
        self.enabled.iter().all(|&word| word == 0)
    }
}
