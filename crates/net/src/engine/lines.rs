//! Compact hash table (quotienting; Cleary 1984) with cache lines of 64 bytes as buckets.
//!
//! A key is scrambled by a permutation. Its high bits are the number of a line, its home; only its low bits are stored,
//! there or in one of the next lines if the home is full, together with the distance from home. So a look-up reads one
//! line, rarely two. Lines are filled from their beginning, and nothing is ever removed.

use super::scramble::Scramble;

/// Entry of 2, 4 or 8 bytes; 0 is an empty slot.
pub(super) trait Entry: Copy + PartialEq + Default {
    /// Number of bits of an entry.
    const BITS: u32 = 8 * size_of::<Self>() as u32;
    fn pack(tag: u64) -> Self;
    fn tag(self) -> u64;
}

macro_rules! entry {
    ($($number:ty),*) => {$(
        impl Entry for $number {
            #[inline(always)]
            fn pack(tag: u64) -> Self {
                tag as Self
            }
            #[inline(always)]
            fn tag(self) -> u64 {
                self.into()
            }
        }
    )*};
}
entry!(u16, u32, u64);

/// Number of bits for the distance from home.
const DISTANCE: u32 = 4;

/// Number of bits of a key that an entry can hold.
pub(super) const fn capacity<E: Entry>() -> u32 {
    // 1 is added to all entries so that none is 0.
    E::BITS - DISTANCE - 1
}

/// Compact hash table of 2^`lines` lines of `N` entries.
pub(super) struct Lines<E, const N: usize> {
    entries: Vec<E>,
    /// Offset of the first line, so that lines are aligned to cache lines.
    first: usize,
    lines: u32,
    /// Number of bits of a key that are stored (the remainder).
    rest: u32,
    scramble: Scramble,
    len: usize,
}

/// Result of inserting a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Entered {
    Old,
    New,
    /// There is no room near the home of the key.
    Full,
}

impl<E: Entry, const N: usize> Lines<E, N> {
    /// Makes an empty table for keys of `bits` bits.
    pub(super) fn new(bits: u32, lines: u32) -> Self
    where
        Vec<E>: FromIterator<E>,
    {
        debug_assert!(bits - lines <= capacity::<E>(), "an entry holds no {bits} bits in 2^{lines} lines");
        let entries = vec![E::default(); (N << lines) + N];
        let first = entries.as_ptr().align_offset(64).min(N);
        Self { entries, first, lines, rest: bits - lines, scramble: Scramble::new(bits), len: 0 }
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// Number of keys above which look-ups become slow.
    pub(super) fn room(&self) -> usize {
        (N << self.lines) / 8 * 7
    }

    pub(super) fn bytes(&self) -> u64 {
        (self.entries.capacity() * size_of::<E>()) as u64
    }

    /// Returns the scrambled key, which the other functions take.
    #[inline(always)]
    pub(super) fn scrambled(&self, key: u64) -> u64 {
        self.scramble.scramble(key)
    }

    #[inline(always)]
    fn line(&self, scrambled: u64) -> usize {
        (scrambled >> self.rest) as usize
    }

    /// Prefetches the home line by reading an entry.
    #[inline(always)]
    pub(super) fn touch(&self, scrambled: u64) -> u64 {
        self.entries[self.first + self.line(scrambled) * N].tag()
    }

    /// Inserts a key unless it is there.
    #[inline(always)]
    pub(super) fn insert(&mut self, scrambled: u64) -> Entered {
        let home = self.line(scrambled);
        let start = self.first + home * N;
        let tag = E::pack((self.rest_of(scrambled) << DISTANCE) + 1);
        let Some(line) = self.entries[start..].first_chunk_mut::<N>() else { return Entered::Full };
        let (used, found) = search(line, tag);
        if used == N && !found {
            return self.insert_away(scrambled);
        }
        // Whether a key is new is unpredictable, so there is no branch on it.
        let at = used.min(N - 1);
        line[at] = if found { line[at] } else { tag };
        self.len += usize::from(!found);
        if found { Entered::Old } else { Entered::New }
    }

    /// Inserts a key whose home is full.
    #[inline(never)]
    fn insert_away(&mut self, scrambled: u64) -> Entered {
        for distance in 1..1 << DISTANCE {
            let tag = E::pack((self.rest_of(scrambled) << DISTANCE | distance as u64) + 1);
            let start = self.first + ((self.line(scrambled) + distance) & ((1 << self.lines) - 1)) * N;
            let Some(line) = self.entries[start..].first_chunk_mut::<N>() else { return Entered::Full };
            let (used, found) = search(line, tag);
            if found {
                return Entered::Old;
            }
            if used < N {
                line[used] = tag;
                self.len += 1;
                return Entered::New;
            }
        }
        Entered::Full
    }

    /// Remainder of a key: the bits that are stored.
    #[inline(always)]
    fn rest_of(&self, scrambled: u64) -> u64 {
        scrambled & !(u64::MAX << self.rest)
    }

    /// Slot of a key, a number below [`Self::slots`], if it is in the table.
    #[inline(always)]
    pub(super) fn slot(&self, scrambled: u64) -> Option<usize> {
        let home = self.line(scrambled);
        let rest = scrambled & !(u64::MAX << self.rest);
        for distance in 0..1 << DISTANCE {
            let tag = E::pack((rest << DISTANCE | distance as u64) + 1);
            let start = ((home + distance) & ((1 << self.lines) - 1)) * N;
            let line = self.entries[self.first + start..].first_chunk::<N>()?;
            // All entries are compared, which avoids an unpredictable branch.
            let at: u32 = line.iter().zip(1..).map(|(&entry, at)| if entry == tag { at } else { 0 }).sum();
            if at > 0 {
                return Some(start + at as usize - 1);
            }
            if line[N - 1] == E::default() {
                return None;
            }
        }
        None
    }

    /// Number of slots.
    pub(super) fn slots(&self) -> usize {
        N << self.lines
    }

    /// Inserts all keys of another table with keys of the same size into this empty one. Returns whether there was
    /// room. Both tables have their keys in the same order, so memory is read and written almost sequentially.
    pub(super) fn append_all<F: Entry, const M: usize>(&mut self, other: &Lines<F, M>) -> bool {
        // Number of entries used in each line. Reading it from the line would wait for the last write.
        let mut used = vec![0_u8; 1 << self.lines];
        for (number, line) in other.entries[other.first..].chunks_exact(M).take(1 << other.lines).enumerate() {
            for &entry in line {
                if entry == F::default() {
                    break;
                }
                let scrambled = other.unpack(number, entry);
                let (home, mut distance) = (self.line(scrambled), 0);
                let mut at = home;
                while usize::from(used[at]) == N {
                    distance += 1;
                    at = (home + distance) & ((1 << self.lines) - 1);
                    if distance >> DISTANCE > 0 {
                        return false;
                    }
                }
                let tag = self.rest_of(scrambled) << DISTANCE | distance as u64;
                self.entries[self.first + at * N + usize::from(used[at])] = E::pack(tag + 1);
                used[at] += 1;
                self.len += 1;
            }
        }
        true
    }

    /// Scrambled key of an entry in a line.
    #[inline(always)]
    fn unpack(&self, line: usize, entry: E) -> u64 {
        let tag = entry.tag() - 1;
        let distance = tag as usize & ((1 << DISTANCE) - 1);
        let home = line.wrapping_sub(distance) & ((1 << self.lines) - 1);
        (home as u64) << self.rest | tag >> DISTANCE
    }

    /// All keys.
    pub(super) fn keys(&self) -> impl Iterator<Item = u64> {
        let used = self.entries[self.first..].chunks_exact(N).take(1 << self.lines).enumerate();
        used.flat_map(move |(number, line)| {
            let used = line.iter().take_while(|entry| **entry != E::default());
            used.map(move |&entry| self.scramble.unscramble(self.unpack(number, entry)))
        })
    }
}

/// Number of used entries of a line, and whether `tag` is one of them.
#[inline(always)]
fn search<E: Entry, const N: usize>(line: &[E; N], tag: E) -> (usize, bool) {
    let (mut used, mut found) = (0, 0);
    for &entry in line {
        used += u32::from(entry != E::default());
        found |= u32::from(entry == tag);
    }
    (used as usize, found > 0)
}
