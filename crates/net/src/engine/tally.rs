//! Maximum numbers of tokens, of each place and of a marking.
//!
//! In each state only two things are recorded: the total, if some transition changes it, and digits that count above 1.
//! A place that never has more than one token has one if it is marked initially or a transition that marks it was ever
//! enabled.

use super::cover::{Content, Rest};
use super::model::Rule;
use super::packing::{Chunk, Packing};

/// Parts of a state that are recorded.
pub(super) struct Meter {
    sums: Vec<Sum>,
    counted: Vec<Counted>,
    /// Total number of tokens, if no transition changes it.
    constant: Option<u64>,
}

/// Contribution of a chunk to the total.
struct Sum {
    chunk: Chunk,
    /// Contribution of each value of the chunk; if empty, the contribution is `base` plus the value.
    table: Vec<i64>,
    base: u64,
}

/// A chunk with digits that count above 1.
struct Counted {
    chunk: Chunk,
    /// Offset in [`Seen::values`], where there is a flag for each value of the chunk that occurred; if the chunk has
    /// too many values, the largest value that occurred.
    start: usize,
}

/// Record of the states seen so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen {
    total: u64,
    values: Vec<u64>,
    /// Transitions that were ever enabled.
    enabled: Vec<u64>,
}

/// Number of values above which a chunk holds one digit.
const TABLE: u64 = 256;

impl Meter {
    pub(super) fn of(packing: &Packing, initial: &[u64], rules: &[Rule]) -> Self {
        let changes = |rule: &Rule| rule.iter().map(|touch| i128::from(touch.change())).sum::<i128>() != 0;
        let constant =
            (!rules.iter().any(changes)).then(|| initial.iter().fold(0, |sum: u64, &n| sum.saturating_add(n)));
        let mut start = 0;
        let mut counted = Vec::new();
        for chunk in &packing.chunks {
            let counts = |content: &Content, radix| matches!(content, Content::Count { .. }) && radix > 2;
            if chunk.digits.iter().any(|(_, digit)| counts(&digit.content, digit.radix)) {
                counted.push(Counted { chunk: chunk.clone(), start });
                start += if chunk.values > TABLE { 1 } else { chunk.values as usize };
            }
        }
        let sums = if constant.is_some() { Vec::new() } else { sums(packing) };
        Self { sums, counted, constant }
    }

    /// Makes an empty record; sets of transitions have `width` words.
    pub(super) fn nothing(&self, width: usize) -> Seen {
        let values = self.counted.last().map_or(0, |last| last.start + last.chunk.values.min(TABLE) as usize);
        Seen { total: self.constant.unwrap_or(0), values: vec![0; values], enabled: vec![0; width] }
    }

    /// Records a marking and the transitions it enables.
    #[inline(always)]
    pub(super) fn note(&self, words: &[u64], enabled: &[u64], seen: &mut Seen) {
        for (seen, enabled) in seen.enabled.iter_mut().zip(enabled) {
            *seen |= enabled;
        }
        for counted in &self.counted {
            let value = counted.chunk.get(words);
            if counted.chunk.values > TABLE {
                seen.values[counted.start] = seen.values[counted.start].max(value);
            } else {
                seen.values[counted.start + value as usize] = 1;
            }
        }
        if !self.sums.is_empty() {
            let total: i128 = self.sums.iter().map(|sum| i128::from(sum.get(words))).sum();
            seen.total = seen.total.max(u64::try_from(total).unwrap_or(u64::MAX));
        }
    }

    /// Maximum number of tokens of each place, and of a marking.
    pub(super) fn maxima(&self, initial: &[u64], rules: &[Rule], seen: &Seen) -> (Vec<u64>, u64) {
        let mut maxima = initial.to_vec();
        for (transition, rule) in rules.iter().enumerate() {
            if seen.enabled[transition / 64] >> (transition % 64) & 1 == 1 {
                rule.iter().for_each(|touch| maxima[touch.place] = maxima[touch.place].max(touch.post.min(1)));
            }
        }
        for counted in &self.counted {
            for (weight, digit) in &counted.chunk.digits {
                let Content::Count { place, base, .. } = digit.content else { continue };
                let top = if counted.chunk.values > TABLE {
                    seen.values[counted.start]
                } else {
                    let values =
                        (0..counted.chunk.values).filter(|&value| seen.values[counted.start + value as usize] > 0);
                    values.map(|value| value / weight % digit.radix).max().unwrap_or(0)
                };
                maxima[place] = maxima[place].max(base + top);
            }
        }
        (maxima, seen.total)
    }
}

impl Seen {
    /// Merges another record into this one.
    pub(super) fn merge(&mut self, other: &Self) {
        self.total = self.total.max(other.total);
        self.values.iter_mut().zip(&other.values).for_each(|(value, other)| *value = (*value).max(*other));
        self.enabled.iter_mut().zip(&other.enabled).for_each(|(set, other)| *set |= other);
    }

    /// Whether a transition was ever enabled.
    pub(super) fn was_enabled(&self, transition: usize) -> bool {
        self.enabled[transition / 64] >> (transition % 64) & 1 == 1
    }
}

impl Sum {
    #[inline(always)]
    fn get(&self, words: &[u64]) -> i64 {
        let value = self.chunk.get(words);
        self.table.get(value as usize).copied().unwrap_or((self.base + value) as i64)
    }
}

/// Contributions of all chunks to the total. A digit that may stand for a token elsewhere ([`Rest::Elsewhere`]) always
/// counts one, so a token that is there is subtracted once for each such digit.
fn sums(packing: &Packing) -> Vec<Sum> {
    let mut twice = vec![0_i64; packing.places()];
    let digits = packing.chunks.iter().flat_map(|chunk| &chunk.digits);
    for content in digits.map(|(_, digit)| &digit.content) {
        if let Content::OneOf { rest: Rest::Elsewhere(others), .. } = content {
            others.iter().for_each(|&other| twice[other] += 1);
        }
    }
    let worth = |content: &Content, value: u64| {
        let marked = content.marked(value);
        marked.map_or(0, |place| content.tokens(place, value) as i64 - twice[place])
    };
    let sum = |chunk: &Chunk| {
        let base = match chunk.digits[0].1.content {
            Content::Count { base, .. } => base,
            Content::OneOf { .. } => 0,
        };
        let is_number = chunk.values > TABLE && matches!(chunk.digits[0].1.content, Content::Count { .. });
        let values = if is_number { 0 } else { chunk.values };
        let value = |value: u64| {
            chunk.digits.iter().map(|(weight, digit)| worth(&digit.content, value / weight % digit.radix)).sum()
        };
        Sum { chunk: chunk.clone(), table: (0..values).map(value).collect(), base }
    };
    packing.chunks.iter().map(sum).collect()
}
