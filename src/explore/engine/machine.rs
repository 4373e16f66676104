//! A net made ready for exploration: packing, tables, and what firing adds.

use super::allowed::Allowed;
use super::conditions::Conditions;
use super::cover::Bounds;
use super::fold::{Above, Fold};
use super::model::Rule;
use super::packing::Packing;
use super::swaps::Swaps;
use super::tally::Meter;

/// Everything a search reads.
pub(super) struct Machine {
    pub(super) packing: Packing,
    /// The initial marking, packed.
    pub(super) initial: Vec<u64>,
    pub(super) transitions: usize,
    /// Words of a set of transitions.
    pub(super) width: usize,
    /// The transitions a marking enables.
    pub(super) enabled: Allowed,
    /// The transitions whose firing no digit is too small for; nothing if that is all.
    pub(super) fits: Option<Allowed>,
    pub(super) swaps: Swaps,
    pub(super) meter: Meter,
    /// What firing a transition adds to a marking of one word.
    pub(super) change: Vec<u64>,
    /// What firing a transition does to a marking of several words.
    pub(super) changes: Vec<Changes>,
}

/// What firing adds to some words, and the nodes of the fold above them.
pub(super) struct Changes {
    pub(super) words: Vec<(usize, u64)>,
    pub(super) above: Above,
}

impl Machine {
    /// Places without a bound are counted up to `limits`.
    pub(super) fn new(initial: &[u64], rules: &[Rule], bounds: &Bounds, limits: &[u64]) -> Self {
        let packing = Packing::of(bounds.digits(limits), initial.len());
        let width = match rules.len().div_ceil(64) {
            0 => 1,
            words @ 1..=4 => words.next_power_of_two(),
            words @ 5..=8 => words.next_multiple_of(2),
            words => words,
        };
        let grows = packing.unproven().next().is_some();
        let fits = grows.then(|| Allowed::of(&packing, &Conditions::fitting(&packing, rules, bounds), width, false));
        let rows: Vec<Vec<u64>> = rules.iter().map(|rule| packing.change(rule)).collect();
        let fold = (packing.words() > 1).then(|| Fold::new(packing.words()));
        let changes = fold.iter().flat_map(|fold| rows.iter().map(|row| Changes::of(row, fold))).collect();
        Self {
            initial: packing.pack(initial).unwrap_or_default(),
            transitions: rules.len(),
            width,
            enabled: Allowed::of(&packing, &Conditions::enabling(&packing, rules), width, true),
            fits,
            swaps: Swaps::of(rules, initial.len(), width),
            meter: Meter::of(&packing, initial, rules),
            change: rows.iter().map(|row| row[0]).collect(),
            changes,
            packing,
        }
    }

    /// Fires a transition.
    pub(super) fn fire(&self, transition: usize, words: &mut [u64]) {
        if let Some(changes) = self.changes.get(transition) {
            changes.words.iter().for_each(|&(word, change)| words[word] = words[word].wrapping_add(change));
        } else {
            words[0] = words[0].wrapping_add(self.change[transition]);
        }
    }

    /// Undoes a firing.
    pub(super) fn unfire(&self, transition: usize, words: &mut [u64]) {
        if let Some(changes) = self.changes.get(transition) {
            changes.words.iter().for_each(|&(word, change)| words[word] = words[word].wrapping_sub(change));
        } else {
            words[0] = words[0].wrapping_sub(self.change[transition]);
        }
    }

    /// Bytes in use.
    pub(super) fn bytes(&self) -> u64 {
        self.enabled.bytes() + self.fits.as_ref().map_or(0, Allowed::bytes) + self.swaps.bytes()
    }
}

impl Changes {
    fn of(row: &[u64], fold: &Fold) -> Self {
        let words: Vec<(usize, u64)> = row.iter().copied().enumerate().filter(|&(_, change)| change != 0).collect();
        let above = fold.above(words.iter().map(|&(word, _)| word));
        Self { words, above }
    }
}
