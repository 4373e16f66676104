//! Sets of numbers as binary decision diagrams over their bits, from the highest to the lowest.

use petril_lang::semantics::Type;

/// Set of patterns of a number of bits: a node of the decision diagram. Equal sets are equal values, and so shared
/// nodes.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Block {
    /// Number of bits not yet decided.
    bits: u32,
    /// Whether the highest undecided bit is a sign.
    sign: bool,
    /// Disjoint ranges, ascending, counted from the least number of the block.
    ranges: Vec<(u128, u128)>,
}

impl Block {
    /// Set of the numbers of a type that are in one of these ranges (ascending, disjoint, both ends included), where
    /// the lowest `bits` bits of the pattern decide, and the others are 0.
    pub fn new(ty: Type, bits: u32, ranges: &[(i128, i128)]) -> Self {
        let sign = ty.is_signed() && bits == ty.width;
        let least = if sign { ty.least() } else { 0 };
        let greatest = least + (1 << bits) - 1;
        let inside =
            ranges.iter().map(|&(from, to)| (from.max(least), to.min(greatest))).filter(|(from, to)| from <= to);
        Self { bits, sign, ranges: inside.map(|(from, to)| ((from - least) as u128, (to - least) as u128)).collect() }
    }

    /// Position of the highest undecided bit; `None` if all are decided.
    pub fn highest(&self) -> Option<u32> {
        self.bits.checked_sub(1)
    }

    pub fn is_empty(&self) -> bool {
        self.ranges.is_empty()
    }

    pub fn is_full(&self) -> bool {
        self.ranges == [(0, (1 << self.bits) - 1)]
    }

    /// Subset in which the highest undecided bit has this value.
    pub fn half(&self, value: bool) -> Self {
        let size = 1_u128 << (self.bits - 1);
        let least = if value ^ self.sign { size } else { 0 };
        let greatest = least + size - 1;
        let inside =
            self.ranges.iter().map(|&(from, to)| (from.max(least), to.min(greatest))).filter(|(from, to)| from <= to);
        Self { bits: self.bits - 1, sign: false, ranges: inside.map(|(from, to)| (from - least, to - least)).collect() }
    }
}
