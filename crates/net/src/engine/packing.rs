//! Layout of the digits of a marking in words.
//!
//! Small digits share a chunk of up to eight bits as a mixed-radix number (their radices multiply to at most 256), so
//! that there can be a table of all values of a chunk. A large digit has a chunk of its own. No chunk crosses the end
//! of a word. Since no digit ever leaves its range, firing a transition is one wrapping addition to each word.

use std::collections::{BTreeMap, BTreeSet};

use super::cover::{Content, Digit, Rest};
use super::model::Rule;

/// Maximum number of values of a chunk of several digits.
const TABLE: u64 = 256;

/// Layout of packed markings.
#[derive(Clone, Debug)]
pub(super) struct Packing {
    pub(super) chunks: Vec<Chunk>,
    /// Number of bits used of each word.
    pub(super) bits: Vec<u32>,
    /// Chunk of each place, and the position of its digit there.
    places: Vec<(usize, usize)>,
}

/// Consecutive bits of a word that hold one or more digits.
#[derive(Clone, Debug)]
pub(super) struct Chunk {
    pub(super) word: usize,
    pub(super) shift: u32,
    pub(super) mask: u64,
    pub(super) values: u64,
    /// Digits, each with its factor in the chunk's value.
    pub(super) digits: Vec<(u64, Digit)>,
}

impl Chunk {
    /// Value of the chunk in a packed marking.
    #[inline]
    pub(super) fn get(&self, words: &[u64]) -> u64 {
        words[self.word] >> self.shift & self.mask
    }

    fn of(digits: Vec<(u64, Digit)>, values: u64) -> Self {
        Self {
            word: 0,
            shift: 0,
            mask: u64::MAX.checked_shr((values - 1).leading_zeros()).unwrap_or(0),
            values,
            digits,
        }
    }

    fn bits(&self) -> u32 {
        self.mask.count_ones()
    }
}

/// Bins for first-fit packing, by the room left in them.
#[derive(Default)]
struct FirstFit(BTreeMap<u64, BTreeSet<usize>>);

impl FirstFit {
    /// Removes and returns the first bin with at least this room.
    fn take(&mut self, room: u64) -> Option<usize> {
        let firsts = self.0.range(room..).filter_map(|(&room, bins)| Some((*bins.first()?, room)));
        let (bin, room) = firsts.min()?;
        self.0.get_mut(&room)?.remove(&bin);
        Some(bin)
    }

    fn put(&mut self, room: u64, bin: usize) {
        self.0.entry(room).or_default().insert(bin);
    }
}

impl Packing {
    pub(super) fn of(mut digits: Vec<Digit>, places: usize) -> Self {
        digits.sort_by_key(|digit| std::cmp::Reverse(digit.radix));
        let mut chunks: Vec<Chunk> = Vec::new();
        let mut open = FirstFit::default();
        for digit in digits {
            let number = open.take(digit.radix).unwrap_or(chunks.len());
            let chunk = if number < chunks.len() {
                let mut together = std::mem::take(&mut chunks[number].digits);
                let weight = chunks[number].values;
                let values = weight * digit.radix;
                together.push((weight, digit));
                chunks[number] = Chunk::of(together, values);
                &chunks[number]
            } else {
                let values = digit.radix;
                chunks.push(Chunk::of(vec![(1, digit)], values));
                &chunks[number]
            };
            open.put(TABLE / chunk.values, number);
        }
        let mut bits: Vec<u32> = Vec::new();
        let mut open = FirstFit::default();
        for chunk in &mut chunks {
            chunk.word = open.take(chunk.bits().into()).unwrap_or(bits.len());
            if chunk.word == bits.len() {
                bits.push(0);
            }
            // A chunk of no bits is never shifted by 64.
            chunk.shift = bits[chunk.word].min(63);
            bits[chunk.word] += chunk.bits();
            open.put((64 - bits[chunk.word]).into(), chunk.word);
        }
        if bits.is_empty() {
            bits.push(0);
        }
        let mut at = vec![(0, 0); places];
        for (number, chunk) in chunks.iter().enumerate() {
            for (position, (_, digit)) in chunk.digits.iter().enumerate() {
                digit.content.places().iter().for_each(|&place| at[place] = (number, position));
            }
        }
        Self { chunks, bits, places: at }
    }

    /// Number of words of a marking.
    pub(super) fn words(&self) -> usize {
        self.bits.len()
    }

    /// Number of places.
    pub(super) fn places(&self) -> usize {
        self.places.len()
    }

    /// Chunk of a place.
    pub(super) fn chunk_of(&self, place: usize) -> usize {
        self.places[place].0
    }

    /// Places that must all be empty for a place to be marked, if its digit alone does not decide it
    /// ([`Rest::Elsewhere`]).
    pub(super) fn elsewhere(&self, place: usize) -> &[usize] {
        let (chunk, position) = self.places[place];
        match &self.chunks[chunk].digits[position].1.content {
            Content::OneOf { places, rest: Rest::Elsewhere(others) } if places[0] == place => others,
            _ => &[],
        }
    }

    /// Packs a marking; `None` if that is impossible, because it violates an invariant or a digit overflows.
    pub(super) fn pack(&self, marking: &[u64]) -> Option<Vec<u64>> {
        let mut words = vec![0; self.words()];
        for chunk in &self.chunks {
            let mut value = 0;
            for (weight, digit) in &chunk.digits {
                value += weight * digit.content.value(marking).filter(|&value| value < digit.radix)?;
            }
            words[chunk.word] |= value << chunk.shift;
        }
        marking.iter().enumerate().all(|(place, &tokens)| self.tokens(&words, place) == tokens).then_some(words)
    }

    /// Number of tokens of a place in a packed marking.
    pub(super) fn tokens(&self, words: &[u64], place: usize) -> u64 {
        let (chunk, position) = self.places[place];
        let chunk = &self.chunks[chunk];
        let (weight, digit) = &chunk.digits[position];
        let tokens = digit.content.tokens(place, chunk.get(words) / weight % digit.radix);
        if self.elsewhere(place).iter().any(|&other| self.tokens(words, other) > 0) { 0 } else { tokens }
    }

    /// Words that firing a transition changes, ascending, and the number it adds to each, wrapping.
    pub(super) fn change(&self, rule: &Rule) -> Vec<(usize, u64)> {
        let mut digits: Vec<(usize, usize)> = rule.iter().map(|touch| self.places[touch.place]).collect();
        digits.sort_unstable();
        digits.dedup();
        let mut changes: Vec<(usize, u64)> = Vec::new();
        for (number, position) in digits {
            let chunk = &self.chunks[number];
            let (weight, digit) = &chunk.digits[position];
            let by = (digit.content.change(rule) as u64).wrapping_mul(*weight) << chunk.shift;
            changes.push((chunk.word, by));
        }
        changes.sort_unstable_by_key(|&(word, _)| word);
        changes.dedup_by(|next, sum| {
            let same = next.0 == sum.0;
            sum.1 = sum.1.wrapping_add(if same { next.1 } else { 0 });
            same
        });
        changes.retain(|&(_, change)| change != 0);
        changes
    }

    /// Whether a digit without a proven bound can count `more` further tokens.
    pub(super) fn has_room(&self, words: &[u64], place: usize, more: u64) -> bool {
        let (chunk, position) = self.places[place];
        let chunk = &self.chunks[chunk];
        let (weight, digit) = &chunk.digits[position];
        more < digit.radix - chunk.get(words) / weight % digit.radix
    }

    /// Places whose digits may overflow, each with the largest value of its digit.
    pub(super) fn unproven(&self) -> impl Iterator<Item = (usize, u64)> {
        self.chunks.iter().flat_map(|chunk| &chunk.digits).filter_map(|(_, digit)| match digit.content {
            Content::Count { place, proven: false, .. } => Some((place, digit.radix - 1)),
            _ => None,
        })
    }
}
