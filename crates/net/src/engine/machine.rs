//! A net prepared for exploration: packing, tables, and the changes by firing.

use super::allowed::Allowed;
use super::conditions::Conditions;
use super::cover::Bounds;
use super::fold::{Above, Fold};
use super::model::Rule;
use super::packing::Packing;
use super::swaps::Swaps;
use super::tally::Meter;

/// A net prepared for exploration; read-only during a search.
pub(super) struct Machine {
    pub(super) packing: Packing,
    /// Packed initial marking.
    pub(super) initial: Vec<u64>,
    pub(super) transitions: usize,
    /// Number of words of a set of transitions.
    pub(super) width: usize,
    /// Table of the transitions that a marking enables.
    pub(super) enabled: Allowed,
    /// Table of the transitions whose firing makes no digit overflow; `None` if no digit can.
    pub(super) fits: Option<Allowed>,
    /// For each transition, the places without a proven bound that it increases, and by how much; empty if there are
    /// none.
    raised: Vec<Vec<(usize, u64)>>,
    pub(super) swaps: Swaps,
    pub(super) meter: Meter,
    /// Number that firing each transition adds to a marking of one word.
    pub(super) change: Vec<u64>,
    /// Changes by each transition to a marking of several words.
    pub(super) changes: Vec<Changes>,
}

/// Numbers that a firing adds to words, and the nodes above these in the compression tree.
pub(super) struct Changes {
    pub(super) words: Vec<(usize, u64)>,
    pub(super) above: Above,
}

impl Machine {
    /// Prepares a net; places without a bound are counted up to `limits`.
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
        let raised = if grows { rules.iter().map(|rule| raised(rule, bounds)).collect() } else { Vec::new() };
        let rows = rules.iter().map(|rule| packing.change(rule));
        let (mut change, mut changes) = (Vec::new(), Vec::new());
        if packing.words() > 1 {
            let fold = Fold::new(packing.words());
            changes =
                rows.map(|words| Changes { above: fold.above(words.iter().map(|&(word, _)| word)), words }).collect();
        } else {
            change = rows.map(|words| words.first().map_or(0, |&(_, change)| change)).collect();
        }
        Self {
            initial: packing.pack(initial).unwrap_or_default(),
            transitions: rules.len(),
            width,
            enabled: Allowed::of(&packing, &Conditions::enabling(&packing, rules), width, true),
            fits,
            raised,
            swaps: Swaps::of(rules, initial.len(), width),
            meter: Meter::of(&packing, initial, rules),
            change,
            changes,
            packing,
        }
    }

    /// Whether firing a transition makes no digit overflow into its neighbour.
    pub(super) fn fits(&self, transition: usize, words: &[u64]) -> bool {
        let raised = self.raised.get(transition).map_or(&[][..], Vec::as_slice);
        raised.iter().all(|&(place, more)| self.packing.has_room(words, place, more))
    }

    /// Fires an enabled transition. Returns false and does nothing if a digit would overflow.
    #[must_use]
    pub(super) fn fire(&self, transition: usize, words: &mut [u64]) -> bool {
        if !self.fits(transition, words) {
            return false;
        }
        if let Some(changes) = self.changes.get(transition) {
            changes.words.iter().for_each(|&(word, change)| words[word] = words[word].wrapping_add(change));
        } else {
            words[0] = words[0].wrapping_add(self.change[transition]);
        }
        true
    }

    /// Undoes a firing.
    pub(super) fn unfire(&self, transition: usize, words: &mut [u64]) {
        if let Some(changes) = self.changes.get(transition) {
            changes.words.iter().for_each(|&(word, change)| words[word] = words[word].wrapping_sub(change));
        } else {
            words[0] = words[0].wrapping_sub(self.change[transition]);
        }
    }

    /// Memory in use, in bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.enabled.bytes() + self.fits.as_ref().map_or(0, Allowed::bytes) + self.swaps.bytes()
    }
}

/// Places without a bound that a transition increases, and by how much.
fn raised(rule: &Rule, bounds: &Bounds) -> Vec<(usize, u64)> {
    let raised = rule.iter().filter(|touch| touch.change() > 0 && !bounds.is_bounded(touch.place));
    raised.map(|touch| (touch.place, touch.change().unsigned_abs())).collect()
}
