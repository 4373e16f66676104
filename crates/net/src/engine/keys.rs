//! The set of all keys seen so far, in the smallest of several representations.
//!
//! In 2^l lines, b - l bits of a key of b bits have to be stored. So the more keys there are, the smaller an entry can
//! be; and if a bit for every possible key takes no more memory than a table, a bit set is used.

use std::hint::black_box;

use super::lines::{Entered, Entry, Lines, capacity};
use petril_search::is_available;

/// A set of keys of a fixed number of bits.
pub(super) struct Keys {
    bits: u32,
    shape: Shape,
    /// Maximum memory of the table and its larger successor together while the table grows, in bytes.
    most: u64,
}

enum Shape {
    /// Bit set with a bit for each possible key.
    Dense {
        set: Vec<u64>,
        len: usize,
    },
    Short(Lines<u16, 32>),
    Medium(Lines<u32, 16>),
    Long(Lines<u64, 8>),
}

/// Number of bits of keys up to which a bit set is always used: 256 KiB.
const DENSE: u32 = 21;

/// Size of tables in bytes that is allowed whatever the limit.
const SMALL: u64 = 1 << 20;

/// Number of keys inserted together. Their lines fit into the innermost cache.
pub(super) const BATCH: usize = 128;

impl Keys {
    /// Makes an empty set for keys of 1 to 64 bits, in lines, with room for `room` keys.
    pub(super) fn in_lines(bits: u32, room: usize) -> Self {
        Self { bits, shape: Shape::lines(bits, room), most: u64::MAX }
    }

    /// Slot of a key, a number below [`Self::slots`], if it is in the set.
    #[inline(always)]
    pub(super) fn slot(&self, key: u64) -> Option<usize> {
        match &self.shape {
            Shape::Dense { set, .. } => (set[key as usize / 64] >> (key % 64) & 1 == 1).then_some(key as usize),
            Shape::Short(lines) => lines.slot(lines.scrambled(key)),
            Shape::Medium(lines) => lines.slot(lines.scrambled(key)),
            Shape::Long(lines) => lines.slot(lines.scrambled(key)),
        }
    }

    /// Prefetches the memory of a key.
    #[inline(always)]
    pub(super) fn touch(&self, key: u64) -> u64 {
        match &self.shape {
            Shape::Dense { set, .. } => set[key as usize / 64],
            Shape::Short(lines) => lines.touch(lines.scrambled(key)),
            Shape::Medium(lines) => lines.touch(lines.scrambled(key)),
            Shape::Long(lines) => lines.touch(lines.scrambled(key)),
        }
    }

    /// Number of slots.
    pub(super) fn slots(&self) -> usize {
        match &self.shape {
            Shape::Dense { set, .. } => set.len() * 64,
            Shape::Short(lines) => lines.slots(),
            Shape::Medium(lines) => lines.slots(),
            Shape::Long(lines) => lines.slots(),
        }
    }

    /// Makes an empty set for keys of 1 to 64 bits.
    pub(super) fn new(bits: u32) -> Self {
        Self { bits, shape: Shape::of(bits, 1 << 15), most: u64::MAX }
    }

    /// Number of bits of a key.
    pub(super) fn bits(&self) -> u32 {
        self.bits
    }

    /// Number of keys.
    pub(super) fn len(&self) -> usize {
        match &self.shape {
            Shape::Dense { len, .. } => *len,
            Shape::Short(lines) => lines.len(),
            Shape::Medium(lines) => lines.len(),
            Shape::Long(lines) => lines.len(),
        }
    }

    /// Memory in use, in bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.shape.bytes()
    }

    /// Limits growth: the table and the larger one may together take at most `most` bytes.
    pub(super) fn grow_within(&mut self, most: u64) {
        self.most = most;
    }

    /// Inserts keys, and calls `new` with the positions of new ones. Returns false if there is no room for some of
    /// them, which are left out.
    #[must_use]
    #[inline]
    pub(super) fn insert(&mut self, keys: &[u64], mut new: impl FnMut(usize)) -> bool {
        for (number, batch) in keys.chunks(BATCH).enumerate() {
            if !self.reserve(batch.len()) {
                return false;
            }
            let start = number * BATCH;
            let mut done = 0;
            while done < batch.len() {
                let (start, batch) = (start + done, &batch[done..]);
                let entered = match &mut self.shape {
                    Shape::Dense { set, len } => dense(set, len, batch, |at| new(start + at)),
                    Shape::Short(lines) => enter(lines, batch, |at| new(start + at)),
                    Shape::Medium(lines) => enter(lines, batch, |at| new(start + at)),
                    Shape::Long(lines) => enter(lines, batch, |at| new(start + at)),
                };
                done += entered;
                if entered < batch.len() && !self.grow() {
                    return false;
                }
            }
        }
        true
    }

    /// Replaces all keys by keys of more bits. Returns false and does nothing if there is no room.
    #[must_use]
    pub(super) fn widen(&mut self, bits: u32, key: impl Fn(u64) -> u64) -> bool {
        // Entries have more bits, and there is room for more of them.
        if !self.may_take(self.bytes().saturating_mul(4)) {
            return false;
        }
        let mut wider = Self { bits, shape: Shape::of(bits, self.len() + (1 << 15)), most: u64::MAX };
        let mut batch = Vec::with_capacity(BATCH);
        let mut complete = true;
        let mut add = |old| {
            batch.push(key(old));
            if batch.len() == BATCH {
                complete &= wider.insert(&batch, |_| {});
                batch.clear();
            }
        };
        match &self.shape {
            Shape::Dense { set, .. } => {
                for (position, &word) in set.iter().enumerate() {
                    (0..64).filter(|bit| word >> bit & 1 == 1).for_each(|bit| add(position as u64 * 64 + bit));
                }
            }
            Shape::Short(lines) => lines.keys().for_each(add),
            Shape::Medium(lines) => lines.keys().for_each(add),
            Shape::Long(lines) => lines.keys().for_each(add),
        }
        complete &= wider.insert(&batch, |_| {});
        wider.most = self.most;
        if complete {
            *self = wider;
        }
        complete
    }

    /// Whether a table of `bytes` bytes may be made beside this one.
    fn may_take(&self, bytes: u64) -> bool {
        self.bytes().saturating_add(bytes) <= self.most.max(SMALL) && is_available(bytes)
    }

    /// Makes room for `more` keys. Returns false if that takes too much memory.
    fn reserve(&mut self, more: usize) -> bool {
        let full = match &self.shape {
            Shape::Dense { .. } => false,
            Shape::Short(lines) => lines.len() + more > lines.room(),
            Shape::Medium(lines) => lines.len() + more > lines.room(),
            Shape::Long(lines) => lines.len() + more > lines.room(),
        };
        !full || self.grow()
    }

    /// Doubles the room. Returns false and does nothing if that takes too much memory.
    fn grow(&mut self) -> bool {
        // Entries never become longer when the table grows.
        if !self.may_take(self.bytes().saturating_mul(2)) {
            return false;
        }
        let room = match &self.shape {
            Shape::Dense { .. } => return true,
            Shape::Short(lines) => lines.room(),
            Shape::Medium(lines) => lines.room(),
            Shape::Long(lines) => lines.room(),
        };
        let mut room = room + 1;
        loop {
            let mut shape = Shape::of(self.bits, room);
            let done = match &self.shape {
                Shape::Dense { .. } => true,
                Shape::Short(lines) => shape.append_all(lines),
                Shape::Medium(lines) => shape.append_all(lines),
                Shape::Long(lines) => shape.append_all(lines),
            };
            if done {
                self.shape = shape;
                return true;
            }
            room *= 2;
        }
    }
}

impl Shape {
    /// Makes the smallest representation with room for `room` keys.
    fn of(bits: u32, room: usize) -> Self {
        let lines = Self::lines(bits, room);
        if bits <= DENSE || bits < 64 && 1 << (bits - 3) <= lines.bytes() {
            Self::Dense { set: vec![0; 1 << bits.saturating_sub(6)], len: 0 }
        } else {
            lines
        }
    }

    /// Makes a table with the smallest entries and room for `room` keys.
    fn lines(bits: u32, room: usize) -> Self {
        // As many lines as there is room for, but no more than possible keys.
        let lines = |per_line: usize| (room * 8 / 7 + 1).div_ceil(per_line).next_power_of_two().ilog2().min(bits - 1);
        let (short, medium, long) = (lines(32), lines(16), lines(8));
        if bits <= capacity::<u16>() + short {
            Self::Short(Lines::new(bits, short))
        } else if bits <= capacity::<u32>() + medium {
            Self::Medium(Lines::new(bits, medium))
        } else {
            // Bits that an entry cannot hold must be in the number of its line, however few keys there are.
            Self::Long(Lines::new(bits, long.max(bits.saturating_sub(capacity::<u64>()))))
        }
    }

    fn bytes(&self) -> u64 {
        match self {
            Self::Dense { set, .. } => set.capacity() as u64 * 8,
            Self::Short(lines) => lines.bytes(),
            Self::Medium(lines) => lines.bytes(),
            Self::Long(lines) => lines.bytes(),
        }
    }
}

impl Shape {
    fn append_all<E: Entry, const N: usize>(&mut self, other: &Lines<E, N>) -> bool {
        match self {
            Self::Dense { set, len } => {
                other.keys().for_each(|key| set[key as usize / 64] |= 1 << (key % 64));
                *len = other.len();
                true
            }
            Self::Short(lines) => lines.append_all(other),
            Self::Medium(lines) => lines.append_all(other),
            Self::Long(lines) => lines.append_all(other),
        }
    }
}

/// Inserts keys until there is no room; returns the number of keys inserted.
#[inline(always)]
fn enter<E: Entry, const N: usize>(lines: &mut Lines<E, N>, keys: &[u64], mut new: impl FnMut(usize)) -> usize {
    let mut scrambled = [0; BATCH];
    let mut seen = 0;
    // The loads are independent, so many of them overlap.
    for (scrambled, &key) in scrambled.iter_mut().zip(keys) {
        *scrambled = lines.scrambled(key);
        seen ^= lines.touch(*scrambled);
    }
    black_box(seen);
    let (mut fresh, mut count) = ([0; BATCH], 0);
    let mut done = keys.len();
    for (at, &scrambled) in scrambled[..keys.len()].iter().enumerate() {
        let entered = lines.insert(scrambled);
        if entered == Entered::Full {
            done = at;
            break;
        }
        fresh[count] = at;
        count += usize::from(entered == Entered::New);
    }
    fresh[..count].iter().for_each(|&at| new(at));
    done
}

#[inline(always)]
fn dense(set: &mut [u64], len: &mut usize, keys: &[u64], mut new: impl FnMut(usize)) -> usize {
    let mut seen = 0;
    for &key in keys {
        seen ^= set[key as usize / 64];
    }
    black_box(seen);
    let (mut fresh, mut count) = ([0; BATCH], 0);
    for (at, &key) in keys.iter().enumerate() {
        let word = &mut set[key as usize / 64];
        fresh[count] = at;
        count += usize::from(*word >> (key % 64) & 1 == 0);
        *word |= 1 << (key % 64);
    }
    *len += count;
    fresh[..count].iter().for_each(|&at| new(at));
    keys.len()
}
