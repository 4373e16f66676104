//! Numbers by chance, the same for the same seed on every machine and for ever.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Where lots are drawn from.
#[derive(Clone, Debug)]
pub struct Lots(ChaCha8Rng);

impl Lots {
    /// Those of a seed.
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// A number below another, which is at most 2⁶⁴.
    pub fn below(&mut self, limit: u128) -> u128 {
        (u128::from(self.0.next_u64()) * limit) >> 64
    }

    /// Any of a list, if it has any.
    pub fn one_of<'a, T>(&mut self, list: &'a [T]) -> Option<&'a T> {
        let position = if list.is_empty() { 0 } else { self.below(list.len() as u128) };
        list.get(position as usize)
    }
}
