//! Conditions of transitions on single places.

use super::cover::{Bounds, Content, Rest};
use super::model::Rule;
use super::packing::{Chunk, Packing};

/// Condition of a transition on a place.
#[derive(Clone, Copy)]
pub(super) enum Condition {
    /// The place has at least this many tokens.
    AtLeast(u64),
    /// The place has no token.
    Empty,
    /// The digit of the place has room for this many more tokens.
    Room(i64),
}

/// For each place, the transitions with a condition on it.
pub(super) struct Conditions {
    of_place: Vec<Vec<(usize, Condition)>>,
    pub(super) transitions: usize,
}

/// Number of values above which a chunk has one digit, and only values at which a condition changes are tabulated.
pub(super) const TABLE: u64 = 256;

impl Conditions {
    /// Conditions for transitions to be enabled.
    pub(super) fn enabling(packing: &Packing, rules: &[Rule]) -> Self {
        let mut of_place = vec![Vec::new(); packing.places()];
        for (transition, rule) in rules.iter().enumerate() {
            for touch in rule.iter().filter(|touch| touch.pre > 0) {
                of_place[touch.place].push((transition, Condition::AtLeast(touch.pre)));
                for &other in packing.elsewhere(touch.place) {
                    of_place[other].push((transition, Condition::Empty));
                }
            }
        }
        Self { of_place, transitions: rules.len() }
    }

    /// Conditions for no digit to overflow in a firing.
    pub(super) fn fitting(packing: &Packing, rules: &[Rule], bounds: &Bounds) -> Self {
        let mut of_place = vec![Vec::new(); packing.places()];
        for (transition, rule) in rules.iter().enumerate() {
            for touch in rule.iter().filter(|touch| touch.change() > 0 && !bounds.is_bounded(touch.place)) {
                of_place[touch.place].push((transition, Condition::Room(touch.change())));
            }
        }
        Self { of_place, transitions: rules.len() }
    }

    /// Transitions with a condition on a chunk that fails at a value of the chunk, possibly with repetitions.
    pub(super) fn failing<'a>(&'a self, chunk: &'a Chunk, value: u64) -> impl Iterator<Item = usize> + 'a {
        chunk.digits.iter().flat_map(move |(weight, digit)| {
            let value = value / weight % digit.radix;
            digit.content.places().iter().flat_map(move |&place| {
                let fails = move |condition: Condition| !condition.holds(&digit.content, digit.radix, place, value);
                self.of_place[place]
                    .iter()
                    .filter(move |(_, condition)| fails(*condition))
                    .map(|&(transition, _)| transition)
            })
        })
    }

    /// Transitions with a condition on a chunk, ascending, each once.
    pub(super) fn touching(&self, chunk: &Chunk) -> Vec<usize> {
        let places = chunk.digits.iter().flat_map(|(_, digit)| digit.content.places());
        let mut touching: Vec<usize> = places.flat_map(|&place| &self.of_place[place]).map(|&(t, _)| t).collect();
        touching.sort_unstable();
        touching.dedup();
        touching
    }

    /// Values of a chunk that allow a transition, for each transition with a condition on the chunk, ascending.
    pub(super) fn allowing(&self, chunk: &Chunk) -> Vec<(usize, Ranges)> {
        let touching = self.touching(chunk);
        if chunk.values <= TABLE {
            let mut fails = vec![false; touching.len()];
            let mut allowing: Vec<(usize, Ranges)> = touching.iter().map(|&t| (t, Ranges::new())).collect();
            for value in 0..chunk.values {
                fails.fill(false);
                let positions =
                    self.failing(chunk, value).filter_map(|transition| touching.binary_search(&transition).ok());
                positions.for_each(|position| fails[position] = true);
                for ((_, ranges), _) in allowing.iter_mut().zip(&fails).filter(|(_, fails)| !**fails) {
                    match ranges.last_mut() {
                        Some((_, last)) if *last + 1 == value => *last = value,
                        _ => ranges.push((value, value)),
                    }
                }
            }
            return allowing;
        }
        let (_, digit) = &chunk.digits[0];
        let mut allowing: Vec<(usize, Ranges)> = touching.iter().map(|&t| (t, vec![(0, digit.radix - 1)])).collect();
        for (position, &place) in digit.content.places().iter().enumerate() {
            for &(transition, condition) in &self.of_place[place] {
                if let Ok(at) = touching.binary_search(&transition) {
                    let ranges = &mut allowing[at].1;
                    *ranges = intersect(ranges, &condition.ranges(&digit.content, position as u64, digit.radix));
                }
            }
        }
        allowing
    }

    /// Values of a chunk, ascending from 0, such that all conditions are constant from one to before the next.
    pub(super) fn values(&self, chunk: &Chunk) -> Vec<u64> {
        if chunk.values <= TABLE {
            return (0..chunk.values).collect();
        }
        let (_, digit) = &chunk.digits[0];
        let mut values = vec![0];
        match &digit.content {
            Content::OneOf { places, rest } => {
                for (value, place) in (u64::from(*rest == Rest::Zero)..).zip(places) {
                    if !self.of_place[*place].is_empty() {
                        values.extend([value, value + 1]);
                    }
                }
            }
            Content::Count { place, base, .. } => {
                // A condition on the number of tokens changes at one value.
                values.extend(self.of_place[*place].iter().map(|(_, condition)| match *condition {
                    Condition::AtLeast(tokens) => tokens.saturating_sub(*base),
                    Condition::Empty => 1,
                    Condition::Room(more) => digit.radix.saturating_sub(more as u64),
                }));
            }
        }
        values.retain(|&value| value < digit.radix);
        values.sort_unstable();
        values.dedup();
        values
    }
}

/// Set of values as ascending ranges, both ends included.
pub(super) type Ranges = Vec<(u64, u64)>;

fn intersect(left: &Ranges, right: &Ranges) -> Ranges {
    let common = |&(a, b): &(u64, u64)| right.iter().map(move |&(c, d)| (a.max(c), b.min(d)));
    left.iter().flat_map(common).filter(|(first, last)| first <= last).collect()
}

impl Condition {
    /// Values of a digit at which the condition on its place at a position holds.
    fn ranges(self, content: &Content, position: u64, radix: u64) -> Ranges {
        let ranges: Ranges = match (self, content) {
            (Self::AtLeast(tokens), Content::Count { base, .. }) => vec![(tokens.saturating_sub(*base), radix - 1)],
            (Self::Empty, Content::Count { base, .. }) => (*base == 0).then_some((0, 0)).into_iter().collect(),
            (Self::Room(more), Content::Count { .. }) => {
                radix.checked_sub(1 + more as u64).map(|last| (0, last)).into_iter().collect()
            }
            (Self::AtLeast(1), Content::OneOf { rest, .. }) => {
                let value = position + u64::from(*rest == Rest::Zero);
                vec![(value, value)]
            }
            (Self::Empty, Content::OneOf { rest, .. }) => {
                let value = position + u64::from(*rest == Rest::Zero);
                let before = value.checked_sub(1).map(|last| (0, last));
                before.into_iter().chain([(value + 1, radix - 1)]).collect()
            }
            (Self::AtLeast(_) | Self::Room(_), Content::OneOf { .. }) => Vec::new(),
        };
        ranges.into_iter().filter(|(first, last)| first <= last).collect()
    }

    /// Whether the condition on a place holds at a value of its digit.
    fn holds(self, content: &Content, radix: u64, place: usize, value: u64) -> bool {
        let tokens = content.tokens(place, value);
        match self {
            Self::AtLeast(tokens_needed) => tokens >= tokens_needed,
            Self::Empty => tokens == 0,
            Self::Room(more) => value as i64 + more < radix as i64,
        }
    }
}
