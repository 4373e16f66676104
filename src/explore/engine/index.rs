//! Numbers for keys, in a table beside that of the keys.

use std::hint::black_box;

use super::keys::{BATCH, Keys};

/// Keys with a number each.
pub(super) struct Index {
    keys: Keys,
    numbers: Vec<u32>,
}

/// Keys with their numbers, which can be gone through again.
type Entries<'a> = &'a dyn Fn(&mut dyn FnMut(u64, u32));

impl Index {
    /// An index of about so many keys of some bits.
    pub(super) fn of(bits: u32, room: usize, entries: Entries<'_>) -> Self {
        let mut keys = Keys::in_lines(bits, room);
        let mut batch = Vec::with_capacity(BATCH);
        entries(&mut |key, _| {
            batch.push(key);
            if batch.len() == BATCH {
                keys.insert(&batch, |_| {});
                batch.clear();
            }
        });
        keys.insert(&batch, |_| {});
        let mut numbers = vec![0; keys.slots()];
        entries(&mut |key, number| {
            if let Some(slot) = keys.slot(key) {
                numbers[slot] = number;
            }
        });
        Self { keys, numbers }
    }

    /// Reports the positions of keys that have a number, with it.
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
