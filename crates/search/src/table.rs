//! Hash table of numbers from 0 whose keys are stored elsewhere, with cache lines of 64 bytes as buckets.
//!
//! An entry is a number and, in the bits that the number does not need, a tag from the key's hash. So a look-up reads
//! one line, rarely two, and usually compares only one key. Nothing is ever removed.

use std::hint::black_box;

/// Number of entries moved to a wider table together, so that their loads overlap.
const TOGETHER: usize = 64;

/// Number of entries of a line; an entry of 0 is empty.
const LINE: usize = 16;

#[derive(Clone, Copy, Default)]
#[repr(align(64))]
struct Line([u32; LINE]);

/// Result of searching a line for a tag.
struct Found {
    /// Number of entries with the tag.
    count: u32,
    /// Sum of the positions of these entries, counted from 1.
    positions: usize,
    /// Number of used entries, which come first.
    used: usize,
}

/// Hash table of numbers. Keys are compared by a callback.
pub struct Table {
    /// 2^`log` lines.
    lines: Vec<Line>,
    log: u32,
    len: usize,
}

impl Default for Table {
    fn default() -> Self {
        Self::with_lines(5)
    }
}

impl Table {
    fn with_lines(log: u32) -> Self {
        Self { lines: vec![Line::default(); 1 << log], log, len: 0 }
    }

    /// Makes room for `more` numbers; `hash` gives the hash of the key of a number in the table.
    #[inline]
    pub fn reserve(&mut self, more: usize, hash: impl Fn(u32) -> u64) {
        while self.len + more > self.lines.len() * LINE / 8 * 7 {
            let mut wider = Self::with_lines(self.log + 1);
            for first in (0..self.len as u32).step_by(TOGETHER) {
                let numbers = first..(first + TOGETHER as u32).min(self.len as u32);
                let mut hashes = [0; TOGETHER];
                let mut touched = 0;
                for (hashed, number) in hashes.iter_mut().zip(numbers.clone()) {
                    *hashed = hash(number);
                    touched ^= wider.touch(*hashed);
                }
                black_box(touched);
                numbers.zip(hashes).for_each(|(number, hash)| wider.append(hash, number));
            }
            *self = wider;
        }
    }

    /// Prefetches the line of a key.
    #[inline(always)]
    pub fn touch(&self, hash: u64) -> u32 {
        self.lines[self.home(hash)].0[0]
    }

    /// Returns the number that is probably that of a key, without comparing keys.
    #[inline(always)]
    pub fn candidate(&self, hash: u64) -> Option<u32> {
        let line = &self.lines[self.home(hash)];
        let found = self.search(line, self.tag(hash));
        (found.count == 1).then(|| self.number(line.0[found.positions - 1]))
    }

    /// Finds the number of a key, if it is there; `is` says whether a number is that of the key.
    #[inline(always)]
    pub fn find(&self, hash: u64, is: impl Fn(u32) -> bool) -> Option<u32> {
        self.look(hash, is).ok()
    }

    /// Returns the number of a key; a new key gets the number `next`. There must be room.
    #[inline(always)]
    pub fn enter(&mut self, hash: u64, next: u32, is: impl Fn(u32) -> bool) -> u32 {
        match self.look(hash, is) {
            Ok(number) => number,
            Err((line, at)) => {
                self.lines[line].0[at] = self.tag(hash) | (next + 1);
                self.len += 1;
                next
            }
        }
    }

    /// Memory in bytes, beside that in use, for making room for `more` numbers; 0 if there is room.
    pub fn growth(&self, more: usize) -> u64 {
        let mut lines = self.lines.len();
        while self.len + more > lines * LINE / 8 * 7 {
            lines *= 2;
        }
        if lines == self.lines.len() { 0 } else { (lines * size_of::<Line>()) as u64 }
    }

    /// Memory in use, in bytes.
    pub fn bytes(&self) -> u64 {
        (self.lines.capacity() * size_of::<Line>()) as u64
    }

    /// Finds the number of a key, or the line and the position where there is room for it.
    #[inline(always)]
    fn look(&self, hash: u64, is: impl Fn(u32) -> bool) -> Result<u32, (usize, usize)> {
        let (mut at, tag) = (self.home(hash), self.tag(hash));
        loop {
            let line = &self.lines[at];
            let found = self.search(line, tag);
            if found.count == 1 {
                let number = self.number(line.0[found.positions - 1]);
                if is(number) {
                    return Ok(number);
                }
            } else if found.count > 1 {
                let tagged = line.0.iter().filter(|&&entry| entry != 0 && entry & !self.numbers() == tag);
                if let Some(number) = tagged.map(|&entry| self.number(entry)).find(|&number| is(number)) {
                    return Ok(number);
                }
            }
            if found.used < LINE {
                return Err((at, found.used));
            }
            at = (at + 1) & (self.lines.len() - 1);
        }
    }

    /// Inserts a number that is not there.
    #[inline(always)]
    fn append(&mut self, hash: u64, number: u32) {
        let mut at = self.home(hash);
        loop {
            let used: u32 = self.lines[at].0.iter().map(|&entry| u32::from(entry != 0)).sum();
            if (used as usize) < LINE {
                self.lines[at].0[used as usize] = self.tag(hash) | (number + 1);
                self.len += 1;
                return;
            }
            at = (at + 1) & (self.lines.len() - 1);
        }
    }

    /// Searches a line for a tag, without branches, so that many entries are compared at once.
    #[inline(always)]
    fn search(&self, line: &Line, tag: u32) -> Found {
        let tags = !self.numbers();
        let (mut count, mut positions, mut used) = (0, 0, 0);
        for (&entry, at) in line.0.iter().zip(1..) {
            let is_used = u32::from(entry != 0);
            let hit = u32::from(entry & tags == tag) & is_used;
            count += hit;
            positions += hit.wrapping_neg() & at;
            used += is_used;
        }
        Found { count, positions: positions as usize, used: used as usize }
    }

    /// Home line of a key, where the search begins.
    #[inline(always)]
    fn home(&self, hash: u64) -> usize {
        (hash >> (64 - self.log)) as usize
    }

    /// Mask of the bits of an entry that hold a number plus 1.
    #[inline(always)]
    fn numbers(&self) -> u32 {
        // There are fewer numbers than entries.
        u32::MAX >> (32 - LINE.ilog2() - self.log)
    }

    #[inline(always)]
    fn tag(&self, hash: u64) -> u32 {
        hash as u32 & !self.numbers()
    }

    #[inline(always)]
    fn number(&self, entry: u32) -> u32 {
        (entry & self.numbers()) - 1
    }
}
