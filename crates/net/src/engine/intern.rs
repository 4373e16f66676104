//! Interning: equal words have equal numbers, assigned in the order of first occurrence.

/// Interned words with their numbers.
#[derive(Default)]
pub(super) struct Interner {
    words: Vec<u64>,
    /// Open hash table: each slot is a number plus 1, or 0 if empty. There are at least twice as many slots as numbers.
    slots: Vec<u32>,
}

impl Interner {
    /// Number of interned words.
    pub(super) fn len(&self) -> usize {
        self.words.len()
    }

    /// The word of a number.
    #[inline(always)]
    pub(super) fn word(&self, number: u32) -> u64 {
        self.words[number as usize]
    }

    /// Returns the number of a word, a new one if it has none.
    #[inline(always)]
    pub(super) fn number(&mut self, word: u64) -> u32 {
        if self.words.len() * 2 >= self.slots.len() {
            self.grow();
        }
        let mut slot = self.home(word);
        loop {
            let number = self.slots[slot];
            if number == 0 {
                self.words.push(word);
                self.slots[slot] = self.words.len() as u32;
                return self.words.len() as u32 - 1;
            }
            if self.words[number as usize - 1] == word {
                return number - 1;
            }
            slot = (slot + 1) & (self.slots.len() - 1);
        }
    }

    /// Finds the number of a word, if it has one.
    pub(super) fn find(&self, word: u64) -> Option<u32> {
        if self.slots.is_empty() {
            return None;
        }
        let mut slot = self.home(word);
        loop {
            let number = self.slots[slot].checked_sub(1)?;
            if self.words[number as usize] == word {
                return Some(number);
            }
            slot = (slot + 1) & (self.slots.len() - 1);
        }
    }

    /// Memory in use, in bytes.
    pub(super) fn bytes(&self) -> u64 {
        (self.words.capacity() * 8 + self.slots.capacity() * 4) as u64
    }

    #[inline(always)]
    fn home(&self, word: u64) -> usize {
        let mixed = (word ^ word >> 32).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        (mixed >> 32 ^ mixed >> 15) as usize & (self.slots.len() - 1)
    }

    fn grow(&mut self) {
        self.slots = vec![0; (self.slots.len() * 2).max(64)];
        for number in 0..self.words.len() {
            let mut slot = self.home(self.words[number]);
            while self.slots[slot] != 0 {
                slot = (slot + 1) & (self.slots.len() - 1);
            }
            self.slots[slot] = number as u32 + 1;
        }
    }
}
