//! Invertible hashing, for compact hash tables: the bits of the hash that are the position of an entry need not be
//! stored.

/// Permutation of the numbers of `bits` bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scramble {
    mask: u64,
    half: u32,
}

/// Odd factors, so that multiplication is invertible.
const FACTORS: [u64; 2] = [0x9E37_79B9_7F4A_7C15, 0xD6E8_FEB8_6659_FD93];

impl Scramble {
    /// Makes the permutation of numbers of 1 to 64 bits.
    pub(super) fn new(bits: u32) -> Self {
        Self { mask: u64::MAX >> (64 - bits), half: bits.div_ceil(2) }
    }

    /// Scrambles a key: the high bits of the result depend on all bits of `key`.
    #[inline(always)]
    pub(super) fn scramble(self, key: u64) -> u64 {
        let mut key = key;
        for factor in FACTORS {
            key ^= key >> self.half;
            key = key.wrapping_mul(factor) & self.mask;
        }
        key
    }

    /// Returns the key that was scrambled.
    pub(super) fn unscramble(self, scrambled: u64) -> u64 {
        let mut key = scrambled;
        for factor in FACTORS.iter().rev() {
            key = key.wrapping_mul(inverse(*factor)) & self.mask;
            key ^= key >> self.half;
        }
        key
    }
}

/// Multiplicative inverse modulo 2^64, and so modulo any smaller power of two, by Newton's iteration, which doubles the
/// number of correct bits each time.
const fn inverse(odd: u64) -> u64 {
    let mut inverse = odd;
    let mut round = 0;
    while round < 5 {
        inverse = inverse.wrapping_mul(2_u64.wrapping_sub(odd.wrapping_mul(inverse)));
        round += 1;
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::Scramble;

    #[test]
    fn every_number_comes_back() {
        for bits in 1..=64 {
            let scramble = Scramble::new(bits);
            for i in 0..1000_u64 {
                let key = i.wrapping_mul(0x1234_5678_9ABC_DEF1).rotate_left(i as u32) & (u64::MAX >> (64 - bits));
                let scrambled = scramble.scramble(key);
                assert!(bits == 64 || scrambled >> bits == 0, "{bits}");
                assert_eq!(scramble.unscramble(scrambled), key, "{bits}");
            }
        }
    }
}
