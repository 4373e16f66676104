//! Encoding of markings as digits, from which the tokens of every place follow.
//!
//! If a place invariant proves that at most one of k places is marked, by one token, they share a digit that says
//! which: log2 k bits instead of k. Sets are chosen greedily, the one that saves most first. Every other place has a
//! digit of its own, which counts its tokens.

use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};

use super::invariants::{Invariant, Wanted, invariants};
use super::model::{Rule, Touch};

/// A digit: a number from 0 up to but not including `radix`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Digit {
    pub(super) radix: u64,
    pub(super) content: Content,
}

/// Meaning of a digit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// The one of these places that is marked.
    OneOf { places: Vec<usize>, rest: Rest },
    /// Number of tokens of the place above `base`. If not `proven`, the digit may overflow.
    Count { place: usize, base: u64, proven: bool },
}

/// Encoding of the case that none of a digit's places is marked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Rest {
    /// Does not occur: one is always marked.
    Never,
    /// Value 0; the places have the values from 1.
    Zero,
    /// Value 0, which also stands for the first place: the token is on one of these places of other digits, and
    /// otherwise on the first place. None of these is itself the first place of such a digit.
    Elsewhere(Vec<usize>),
}

/// Number of bits that a set of places saves.
#[derive(Clone, Copy, Debug)]
struct Saving(f64);

impl Ord for Saving {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Saving {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Saving {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Saving {}

/// Bounds on the places of a net by invariants.
pub(super) struct Bounds {
    /// Sets of places of which exactly one is marked, with one token.
    one_token: Vec<Vec<usize>>,
    /// Upper bound on the tokens of each place, where known.
    bounds: Vec<Option<u64>>,
    /// Whether a transition changes the place, for each place.
    changes: Vec<bool>,
    initial: Vec<u64>,
}

impl Bounds {
    pub(super) fn of(initial: &[u64], rules: &[Rule]) -> Self {
        let mut changes = vec![false; initial.len()];
        for touch in rules.iter().flatten() {
            changes[touch.place] |= touch.change() != 0;
        }
        let mut bounds: Vec<Option<u64>> = vec![None; initial.len()];
        let mut learn = |found: &[Invariant]| {
            for invariant in found {
                for &(place, weight) in &invariant.weights {
                    let bound = invariant.tokens / weight;
                    bounds[place] = Some(bounds[place].map_or(bound, |known| known.min(bound)));
                }
            }
            bounds.contains(&None)
        };
        let single = invariants(initial, rules, Wanted::OneToken);
        if learn(&single) {
            learn(&invariants(initial, rules, Wanted::Any));
        }
        let one_token = single.iter().filter(|invariant| invariant.tokens == 1);
        let one_token =
            one_token.map(|invariant| invariant.weights.iter().map(|&(place, _)| place).collect()).collect();
        Self { one_token, bounds, changes, initial: initial.to_vec() }
    }

    /// Chooses digits for all places. Places without a bound are counted up to `limits`.
    pub(super) fn digits(&self, limits: &[u64]) -> Vec<Digit> {
        let mut digits = Vec::new();
        let mut left: Vec<bool> =
            (0..self.initial.len()).map(|place| self.changes[place] && self.bounds[place] != Some(0)).collect();
        let counted = |place: usize| {
            let initial = self.initial[place];
            let (base, top, proven) = match self.bounds[place] {
                _ if !self.changes[place] => (initial, initial, true),
                Some(bound) => (0, bound, true),
                None => (0, limits[place], false),
            };
            Digit { radix: top - base + 1, content: Content::Count { place, base, proven } }
        };
        let mut firsts = vec![false; self.initial.len()];
        let saving = |set: &[usize], left: &[bool], firsts: &[bool]| {
            let part = set.iter().filter(|&&place| left[place]).count();
            let own = set.iter().any(|&place| firsts[place]);
            Saving(part as f64 - ((part + usize::from(own)).max(1) as f64).log2())
        };
        // Savings only shrink, so earlier values are upper bounds (lazy greedy).
        let sets = self.one_token.iter().enumerate();
        let mut waiting: BinaryHeap<(Saving, usize)> =
            sets.map(|(number, set)| (saving(set, &left, &firsts), number)).collect();
        while let Some((_, number)) = waiting.pop() {
            let set = &self.one_token[number];
            let now = (saving(set, &left, &firsts), number);
            if now.0 <= Saving(0.0) {
                continue;
            }
            if waiting.peek().is_some_and(|next| *next > now) {
                waiting.push(now);
                continue;
            }
            let (places, others): (Vec<usize>, Vec<usize>) = set.iter().partition(|&&place| left[place]);
            places.iter().for_each(|&place| left[place] = false);
            let rest = if others.is_empty() {
                Rest::Never
            } else if others.iter().any(|&place| firsts[place]) {
                Rest::Zero
            } else {
                firsts[places[0]] = true;
                Rest::Elsewhere(others)
            };
            let radix = (places.len() + usize::from(rest == Rest::Zero)) as u64;
            digits.push(Digit { radix, content: Content::OneOf { places, rest } });
        }
        let rest = (0..self.initial.len())
            .filter(|place| left[*place] || !self.changes[*place] || self.bounds[*place] == Some(0));
        let shared: BTreeSet<usize> = digits.iter().flat_map(|digit| digit.content.places()).copied().collect();
        digits.extend(rest.filter(|place| !shared.contains(place)).map(counted));
        digits
    }

    /// Whether a place is proven to have at most one token.
    pub(super) fn is_safe(&self, place: usize) -> bool {
        self.bounds[place].is_some_and(|bound| bound <= 1) || !self.changes[place] && self.initial[place] <= 1
    }

    /// Whether the number of tokens of a place is proven to be bounded.
    pub(super) fn is_bounded(&self, place: usize) -> bool {
        self.bounds[place].is_some() || !self.changes[place]
    }
}

impl Content {
    /// Places that the digit encodes.
    pub(super) fn places(&self) -> &[usize] {
        match self {
            Self::OneOf { places, .. } => places,
            Self::Count { place, .. } => std::slice::from_ref(place),
        }
    }

    /// The place marked at a value, if any. With [`Rest::Elsewhere`], the first place may be unmarked nevertheless.
    pub(super) fn marked(&self, value: u64) -> Option<usize> {
        match self {
            Self::OneOf { places, rest } => {
                places.get(value.wrapping_sub(u64::from(*rest == Rest::Zero)) as usize).copied()
            }
            Self::Count { place, base, .. } => (base + value > 0).then_some(*place),
        }
    }

    /// Number of tokens on a place of the digit at a value. With [`Rest::Elsewhere`], the first place may have none
    /// nevertheless.
    pub(super) fn tokens(&self, place: usize, value: u64) -> u64 {
        match self {
            Self::OneOf { .. } => u64::from(self.marked(value) == Some(place)),
            Self::Count { base, .. } => base + value,
        }
    }

    /// Value of the digit in a marking, if there is one.
    pub(super) fn value(&self, marking: &[u64]) -> Option<u64> {
        match self {
            Self::OneOf { places, rest } => {
                let marked = places.iter().position(|&place| marking[place] > 0);
                Some(marked.map_or(0, |code| code as u64 + u64::from(*rest == Rest::Zero)))
            }
            Self::Count { place, base, .. } => marking[*place].checked_sub(*base),
        }
    }

    /// Change of the digit by a firing.
    pub(super) fn change(&self, rule: &Rule) -> i64 {
        let at = |place: usize| rule.binary_search_by_key(&place, |touch| touch.place).ok().map(|found| rule[found]);
        match self {
            Self::Count { place, .. } => at(*place).map_or(0, Touch::change),
            Self::OneOf { places, rest } => {
                let value = |marked: &dyn Fn(Touch) -> bool| {
                    let code = places.iter().position(|&place| at(place).is_some_and(marked));
                    code.map_or(0, |code| code as i64 + i64::from(*rest == Rest::Zero))
                };
                if places.iter().all(|&place| at(place).is_none()) {
                    return 0;
                }
                value(&|touch| touch.post > 0) - value(&|touch| touch.pre > 0)
            }
        }
    }
}
