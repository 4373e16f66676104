//! Sets of numbers as decisions over bits, from the highest to the lowest.

use petril_lang::semantics::Type;

/// Some of the patterns of a number of bits. Equal sets are equal values, so that a decision diagram shares them.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Block {
    /// How many bits are not yet decided.
    bits: u32,
    /// Whether the highest of them is a sign.
    sign: bool,
    /// Disjoint ranges, ascending, counted from the least number of the block.
    ranges: Vec<(u128, u128)>,
}

impl Block {
    /// Those numbers of a type that are in one of these ranges (ascending, disjoint, both ends included), where the lowest
    /// `bits` bits of the pattern decide, and the others are 0.
    pub fn new(ty: Type, bits: u32, ranges: &[(i128, i128)]) -> Self {
        let sign = ty.is_signed() && bits == ty.width;
        let least = if sign { ty.least() } else { 0 };
        let greatest = least + (1 << bits) - 1;
        let inside =
            ranges.iter().map(|&(from, to)| (from.max(least), to.min(greatest))).filter(|(from, to)| from <= to);
        Self { bits, sign, ranges: inside.map(|(from, to)| ((from - least) as u128, (to - least) as u128)).collect() }
    }

    /// The position of the highest bit; none is left if there is no decision to be made.
    pub fn highest(&self) -> Option<u32> {
        self.bits.checked_sub(1)
    }

    pub fn is_empty(&self) -> bool {
        self.ranges.is_empty()
    }

    pub fn is_full(&self) -> bool {
        self.ranges == [(0, (1 << self.bits) - 1)]
    }

    /// Those in which the highest bit has this value.
    pub fn half(&self, value: bool) -> Self {
        let size = 1_u128 << (self.bits - 1);
        let least = if value ^ self.sign { size } else { 0 };
        let greatest = least + size - 1;
        let inside =
            self.ranges.iter().map(|&(from, to)| (from.max(least), to.min(greatest))).filter(|(from, to)| from <= to);
        Self { bits: self.bits - 1, sign: false, ranges: inside.map(|(from, to)| (from - least, to - least)).collect() }
    }
}
