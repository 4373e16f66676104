//! Random numbers, reproducible from the seed on every machine and in every version.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Random number generator (ChaCha8).
#[derive(Clone, Debug)]
pub struct Lots(ChaCha8Rng);

impl Lots {
    /// Creates the generator for a seed.
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// Random number below a limit of at most 2⁶⁴.
    pub fn below(&mut self, limit: u128) -> u128 {
        (u128::from(self.0.next_u64()) * limit) >> 64
    }

    /// Random element of a list; `None` if it is empty.
    pub fn one_of<'a, T>(&mut self, list: &'a [T]) -> Option<&'a T> {
        let position = if list.is_empty() { 0 } else { self.below(list.len() as u128) };
        list.get(position as usize)
    }
}
