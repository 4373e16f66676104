//! Tables of the transitions that a marking allows.
//!
//! For each value of each chunk there is a row of bits, one for each transition: whether the places of that chunk allow
//! it. The set of transitions that a marking allows is the conjunction of the rows of its chunks.

use super::conditions::{Conditions, TABLE};
use super::packing::{Chunk, Packing};

/// For each value of chunks the transitions it allows.
pub(super) struct Rows {
    tables: Vec<Table>,
    rows: Vec<u64>,
    /// Row of all transitions.
    all: Vec<u64>,
}

/// Rows of a chunk.
struct Table {
    word: usize,
    shift: u32,
    mask: u64,
    /// Offset of the first row.
    start: usize,
    /// Values at which a new row begins, except 0; `None` if there is a row for each value.
    breaks: Option<Vec<u64>>,
}

impl Rows {
    /// Builds the tables, with rows of `width` words.
    pub(super) fn of(packing: &Packing, conditions: &Conditions, width: usize) -> Self {
        let mut all = vec![0; width];
        (0..conditions.transitions).for_each(|transition| all[transition / 64] |= 1 << (transition % 64));
        let mut rows = Self { tables: Vec::new(), rows: Vec::new(), all };
        packing.chunks.iter().for_each(|chunk| rows.add(chunk, conditions));
        rows
    }

    /// Adds the rows of a chunk, unless it has no conditions.
    fn add(&mut self, chunk: &Chunk, conditions: &Conditions) {
        if conditions.touching(chunk).is_empty() {
            return;
        }
        let start = self.rows.len();
        let values = conditions.values(chunk);
        for &value in &values {
            let row = self.rows.len();
            self.rows.extend_from_slice(&self.all);
            for transition in conditions.failing(chunk, value) {
                self.rows[row + transition / 64] &= !(1 << (transition % 64));
            }
        }
        let breaks = (chunk.values > TABLE).then(|| values[1..].to_vec());
        self.tables.push(Table { word: chunk.word, shift: chunk.shift, mask: chunk.mask, start, breaks });
    }

    /// Whether every marking allows all transitions.
    pub(super) fn is_empty(&self) -> bool {
        self.tables.is_empty()
    }

    /// Writes the transitions that the marking allows into `set`.
    #[inline(always)]
    pub(super) fn put(&self, words: &[u64], set: &mut [u64]) {
        let Some((first, others)) = self.tables.split_first() else {
            set.copy_from_slice(&self.all);
            return;
        };
        set.copy_from_slice(&self.rows[first.row(words, set.len())..][..set.len()]);
        for table in others {
            let row = &self.rows[table.row(words, set.len())..][..set.len()];
            for (word, row) in set.iter_mut().zip(row) {
                *word &= row;
            }
        }
    }

    /// Whether the marking allows all transitions of a set.
    #[inline]
    pub(super) fn allows(&self, words: &[u64], set: &[u64]) -> bool {
        self.tables.iter().all(|table| {
            let row = &self.rows[table.row(words, set.len())..][..set.len()];
            set.iter().zip(row).fold(0, |missing, (word, row)| missing | word & !row) == 0
        })
    }

    /// Memory in use, in bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.rows.capacity() as u64 * 8
    }
}

impl Table {
    /// Offset of the row of a marking.
    #[inline(always)]
    fn row(&self, words: &[u64], width: usize) -> usize {
        let value = words[self.word] >> self.shift & self.mask;
        match &self.breaks {
            None => self.start + value as usize * width,
            Some(breaks) => self.start + breaks.partition_point(|&at| at <= value) * width,
        }
    }
}
