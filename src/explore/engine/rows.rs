//! Tables that say which transitions a marking allows.
//!
//! For each value of each chunk there is a row of bits, one for each transition: whether the places of that chunk allow it.
//! What a marking allows is the conjunction of the rows of its chunks.

use super::cover::{Bounds, Content, Rest};
use super::model::Rule;
use super::packing::{Chunk, Packing};

/// For each value of some chunks the transitions it allows.
pub(super) struct Rows {
    /// Words of a row.
    width: usize,
    tables: Vec<Table>,
    rows: Vec<u64>,
    /// A bit for each transition.
    all: Vec<u64>,
}

/// The rows of a chunk.
struct Table {
    word: usize,
    shift: u32,
    mask: u64,
    /// Where the first row begins.
    start: usize,
    /// If not empty: the values at which a new row begins, except 0.
    breaks: Vec<u64>,
}

/// What a place has to be like for a transition.
#[derive(Clone, Copy)]
enum Condition {
    /// It has so many tokens.
    AtLeast(u64),
    /// It has none.
    Empty,
    /// So many more can be counted.
    Room(i64),
}

/// For each place, the transitions with a condition on it.
type Conditions = Vec<Vec<(usize, Condition)>>;

/// Chunks with more values than this have one row for several values.
const TABLE: u64 = 256;

impl Rows {
    /// The transitions that are enabled. Rows have `width` words.
    pub(super) fn enabled(packing: &Packing, rules: &[Rule], width: usize) -> Self {
        let mut conditions: Conditions = vec![Vec::new(); packing.places()];
        for (transition, rule) in rules.iter().enumerate() {
            for touch in rule.iter().filter(|touch| touch.pre > 0) {
                conditions[touch.place].push((transition, Condition::AtLeast(touch.pre)));
                for &other in packing.elsewhere(touch.place) {
                    conditions[other].push((transition, Condition::Empty));
                }
            }
        }
        Self::of(packing, &conditions, rules.len(), width)
    }

    /// The transitions whose firing no digit is too small for.
    pub(super) fn fitting(packing: &Packing, rules: &[Rule], bounds: &Bounds, width: usize) -> Self {
        let mut conditions: Conditions = vec![Vec::new(); packing.places()];
        for (transition, rule) in rules.iter().enumerate() {
            for touch in rule.iter().filter(|touch| touch.change() > 0 && !bounds.is_bounded(touch.place)) {
                conditions[touch.place].push((transition, Condition::Room(touch.change())));
            }
        }
        Self::of(packing, &conditions, rules.len(), width)
    }

    fn of(packing: &Packing, conditions: &Conditions, transitions: usize, width: usize) -> Self {
        let mut all = vec![0; width];
        (0..transitions).for_each(|transition| all[transition / 64] |= 1 << (transition % 64));
        let mut rows = Self { width, tables: Vec::new(), rows: Vec::new(), all };
        packing.chunks.iter().for_each(|chunk| rows.add(chunk, conditions));
        rows
    }

    /// Adds the rows of a chunk, unless it always allows everything.
    fn add(&mut self, chunk: &Chunk, conditions: &Conditions) {
        let breaks = if chunk.values > TABLE { breaks(chunk, conditions) } else { Vec::new() };
        let values: Vec<u64> = if chunk.values > TABLE {
            std::iter::once(0).chain(breaks.iter().copied()).collect()
        } else {
            (0..chunk.values).collect()
        };
        let start = self.rows.len();
        for &value in &values {
            let row = self.rows.len();
            self.rows.extend_from_slice(&self.all);
            for (weight, digit) in &chunk.digits {
                let value = value / weight % digit.radix;
                for &place in digit.content.places() {
                    for &(transition, condition) in &conditions[place] {
                        if !condition.holds(&digit.content, digit.radix, place, value) {
                            self.rows[row + transition / 64] &= !(1 << (transition % 64));
                        }
                    }
                }
            }
        }
        if self.rows[start..].chunks_exact(self.width).all(|row| row == self.all) {
            self.rows.truncate(start);
        } else {
            self.tables.push(Table { word: chunk.word, shift: chunk.shift, mask: chunk.mask, start, breaks });
        }
    }

    /// Whether every marking allows everything.
    pub(super) fn is_empty(&self) -> bool {
        self.tables.is_empty()
    }

    /// Puts into `set` what the marking allows.
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

    /// Whether the marking allows all of a set.
    #[inline]
    pub(super) fn allows(&self, words: &[u64], set: &[u64]) -> bool {
        self.tables.iter().all(|table| {
            let row = &self.rows[table.row(words, set.len())..][..set.len()];
            set.iter().zip(row).fold(0, |missing, (word, row)| missing | word & !row) == 0
        })
    }

    /// Bytes in use.
    pub(super) fn bytes(&self) -> u64 {
        self.rows.capacity() as u64 * 8
    }
}

impl Table {
    /// Where the row of a marking begins.
    #[inline(always)]
    fn row(&self, words: &[u64], width: usize) -> usize {
        let value = words[self.word] >> self.shift & self.mask;
        if self.breaks.is_empty() {
            self.start + value as usize * width
        } else {
            self.start + self.breaks.partition_point(|&at| at <= value) * width
        }
    }
}

impl Condition {
    /// Whether the condition on a place holds if its digit has a value.
    fn holds(self, content: &Content, radix: u64, place: usize, value: u64) -> bool {
        let tokens = content.tokens(place, value);
        match self {
            Self::AtLeast(tokens_needed) => tokens >= tokens_needed,
            Self::Empty => tokens == 0,
            Self::Room(more) => value as i64 + more < radix as i64,
        }
    }
}

/// The values of a chunk of one digit at which a condition can change for some transition.
fn breaks(chunk: &Chunk, conditions: &Conditions) -> Vec<u64> {
    let (_, digit) = &chunk.digits[0];
    let mut breaks = Vec::new();
    match &digit.content {
        Content::OneOf { places, rest } => {
            for (value, place) in (u64::from(*rest == Rest::Zero)..).zip(places) {
                if !conditions[*place].is_empty() {
                    breaks.extend([value, value + 1]);
                }
            }
        }
        Content::Count { place, base, .. } => {
            // A condition on a number of tokens changes at one value.
            breaks.extend(conditions[*place].iter().map(|(_, condition)| match *condition {
                Condition::AtLeast(tokens) => tokens.saturating_sub(*base),
                Condition::Empty => 1,
                Condition::Room(more) => digit.radix.saturating_sub(more as u64),
            }));
        }
    }
    breaks.retain(|&value| value > 0 && value < digit.radix);
    breaks.sort_unstable();
    breaks.dedup();
    breaks
}
