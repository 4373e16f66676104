//! Layout of the parts of a state in words.

/// Bit field within one word of a state.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    word: usize,
    shift: u32,
    mask: u64,
}

impl Field {
    /// Value of the field.
    pub fn get(self, state: &[u64]) -> u64 {
        state[self.word] >> self.shift & self.mask
    }

    /// Sets the field to the low bits of `value`.
    pub fn set(self, state: &mut [u64], value: u64) {
        state[self.word] = state[self.word] & !(self.mask << self.shift) | (value & self.mask) << self.shift;
    }

    /// Word and bit of each bit of the field, the least significant first.
    pub fn positions(self) -> impl Iterator<Item = (usize, u32)> {
        (0..self.mask.count_ones()).map(move |bit| (self.word, self.shift + bit))
    }
}

/// Consecutive fields, none across the end of a word.
#[derive(Debug)]
pub struct Layout {
    /// Number of bits used of each word.
    used: Vec<u32>,
}

impl Default for Layout {
    /// Layout without fields, of one word.
    fn default() -> Self {
        Self { used: vec![0] }
    }
}

impl Layout {
    /// Number of words, at least one.
    pub fn words(&self) -> usize {
        self.used.len()
    }

    /// Allocates a field of 0 to 64 bits.
    pub fn field(&mut self, bits: u32) -> Field {
        if self.used.last().is_some_and(|&used| used + bits > 64) {
            self.used.push(0);
        }
        let word = self.used.len() - 1;
        let shift = self.used[word];
        self.used[word] += bits;
        // A field of no bits is never shifted by 64.
        Field { word, shift: shift.min(63), mask: u64::MAX.checked_shr(64 - bits).unwrap_or(0) }
    }
}

#[cfg(test)]
mod tests {
    use super::Layout;

    #[test]
    fn fields_do_not_touch_each_other() {
        let mut layout = Layout::default();
        let bits = [0, 1, 16, 64, 0, 3, 61, 0, 8];
        let fields = bits.map(|bits| layout.field(bits));
        // 0 + 1 + 16; 64 + 0; 3 + 61 + 0; 8
        assert_eq!(layout.words(), 4);
        for (i, field) in fields.iter().enumerate() {
            for background in [0, u64::MAX] {
                let mut state = vec![background; layout.words()];
                field.set(&mut state, !background);
                for (j, other) in fields.iter().enumerate() {
                    let full = u64::MAX.checked_shr(64 - bits[j]).unwrap_or(0);
                    let expected = if (i == j) == (background == 0) { full } else { 0 };
                    assert_eq!(other.get(&state), expected, "{i} set, {j} read");
                }
            }
        }
    }
}
