//! Map from keys to numbers: a table of numbers beside the set of keys.

use std::hint::black_box;

use super::keys::{BATCH, Keys};
use petril_search::is_available;

/// Map from keys to numbers.
pub(super) struct Index {
    keys: Keys,
    numbers: Vec<u32>,
}

/// Repeatable iteration over keys with their numbers.
type Entries<'a> = &'a dyn Fn(&mut dyn FnMut(u64, u32));

impl Index {
    /// Builds an index of about `room` keys of `bits` bits. `None` if there is too little memory.
    pub(super) fn of(bits: u32, room: usize, entries: Entries<'_>) -> Option<Self> {
        // Entries of 8 bytes and numbers of 4, with room to spare.
        if !is_available(room as u64 * 32) {
            return None;
        }
        let mut complete = true;
        let mut keys = Keys::in_lines(bits, room);
        let mut batch = Vec::with_capacity(BATCH);
        entries(&mut |key, _| {
            batch.push(key);
            if batch.len() == BATCH {
                complete &= keys.insert(&batch, |_| {});
                batch.clear();
            }
        });
        complete &= keys.insert(&batch, |_| {});
        let mut numbers = vec![0; keys.slots()];
        entries(&mut |key, number| {
            if let Some(slot) = keys.slot(key) {
                numbers[slot] = number;
            }
        });
        complete.then_some(Self { keys, numbers })
    }

    /// Calls `found` with the position and the number of each key that has one.
    pub(super) fn find(&self, keys: &[u64], mut found: impl FnMut(usize, u32)) {
        for (batch, start) in keys.chunks(BATCH).zip((0..).step_by(BATCH)) {
            black_box(batch.iter().fold(0, |seen, &key| seen ^ self.keys.touch(key)));
            let mut slots = [None; BATCH];
            batch.iter().zip(&mut slots).for_each(|(&key, slot)| *slot = self.keys.slot(key));
            for (position, slot) in slots.iter().take(batch.len()).enumerate() {
                if let Some(slot) = *slot {
                    found(start + position, self.numbers[slot]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Few keys of many bits that differ in only one bit: each has its own number, whichever bit it is.
    #[test]
    fn wide_keys_in_small_indices_are_told_apart() {
        for bits in 2..=64_u32 {
            let single = |bit: u32| 1_u64 << bit;
            let all: Vec<u64> = (0..bits).map(single).chain([0]).collect();
            for keys in [all.as_slice(), &[0, 1, single(bits - 1)], &[single(bits - 1), single(bits - 2)]] {
                let entries = |enter: &mut dyn FnMut(u64, u32)| {
                    keys.iter().zip(0..).for_each(|(&key, number)| enter(key, number));
                };
                let index = Index::of(bits, keys.len(), &entries).unwrap();
                let mut found = vec![None; keys.len()];
                index.find(keys, |position, number| found[position] = Some(number));
                let mut expected = vec![None; keys.len()];
                // A key that occurs twice has the last number.
                entries(&mut |key, number| {
                    let same = keys.iter().enumerate().filter(|(_, other)| **other == key);
                    same.for_each(|(position, _)| expected[position] = Some(number));
                });
                assert_eq!(found, expected, "{bits} bits: {keys:x?}");
            }
        }
    }
}
