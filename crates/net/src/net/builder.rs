//! Builder of nets: places and transitions are added one by one; a finished net is immutable.

use std::collections::BTreeMap;

use super::{Arcs, Net, PlaceId, TransitionId};

/// Builds a [`Net`].
///
/// Names are taken as they are. The caller keeps them unique among places and among transitions.
#[derive(Clone, Debug)]
pub struct Builder {
    net: Net,
    /// Scratch memory: uses of places by the transition being added.
    uses: Vec<(PlaceId, Use)>,
}

/// Uses of a place by a transition, as bits.
type Use = u8;
const CONSUME: Use = 1;
const PRODUCE: Use = 2;
const READ: Use = 4;
/// Self-loop: the token is taken and put back.
const LOOP: Use = CONSUME | PRODUCE;

impl Builder {
    /// Begins with an empty net.
    pub fn new(name: impl Into<String>) -> Self {
        Self { net: Net::empty(name.into()), uses: Vec::new() }
    }

    /// Adds a place.
    pub fn place(&mut self, name: impl AsRef<str>, marked: bool) -> PlaceId {
        self.place_with(name, u64::from(marked))
    }

    /// Adds a place with `tokens` tokens.
    pub fn place_with(&mut self, name: impl AsRef<str>, tokens: u64) -> PlaceId {
        self.net.place_names.push(name.as_ref());
        self.net.tokens.push(tokens);
        PlaceId::at(self.net.tokens.len() - 1)
    }

    /// The name of a place that has been added.
    #[must_use]
    pub fn place_name(&self, place: PlaceId) -> &str {
        self.net.place_names.get(place.index())
    }

    /// Adds a transition. A place in both preset and postset becomes a read place. A read place that is also in the
    /// preset stays in the preset only, since both require the same token.
    pub fn transition(&mut self, name: impl AsRef<str>, arcs: Arcs<'_>) -> TransitionId {
        self.uses.clear();
        for (places, this) in [(arcs.consume, CONSUME), (arcs.produce, PRODUCE), (arcs.read, READ)] {
            self.uses.extend(places.iter().map(|&place| (place, this)));
        }
        self.uses.sort_unstable_by_key(|&(place, _)| place);
        self.uses.dedup_by(|(later, other), (place, uses)| {
            let is_same = later == place;
            *uses |= if is_same { *other } else { 0 };
            is_same
        });
        self.net.transition_names.push(name.as_ref());
        self.net.arcs.push(
            places(&self.uses, |uses| uses & LOOP == CONSUME),
            places(&self.uses, |uses| uses & LOOP == PRODUCE),
            places(&self.uses, |uses| uses & LOOP == LOOP || uses & (READ | CONSUME) == READ),
        )
    }

    /// Adds a transition with weighted arcs: tokens taken, tokens put, and tokens that must be there without being
    /// taken. Weights of arcs that join the same nodes add up.
    pub fn weighted(
        &mut self,
        name: impl AsRef<str>,
        take: &[(PlaceId, u64)],
        put: &[(PlaceId, u64)],
        test: &[(PlaceId, u64)],
    ) -> TransitionId {
        let mut needs: BTreeMap<PlaceId, [u64; 3]> = BTreeMap::new();
        for (list, position) in [(take, 0), (put, 1), (test, 2)] {
            for &(place, weight) in list {
                let sum = &mut needs.entry(place).or_default()[position];
                *sum = sum.saturating_add(weight);
            }
        }
        for [take, put, test] in needs.values_mut() {
            let pre = (*take).max(*test);
            let post = (pre - *take).saturating_add(*put);
            let read = pre.min(post);
            [*take, *put, *test] = [pre - read, post - read, read];
        }
        let list = |position: usize| {
            needs.iter().map(move |(&place, weights)| (place, weights[position])).filter(|&(_, weight)| weight > 0)
        };
        self.net.transition_names.push(name.as_ref());
        self.net.arcs.push(list(0), list(1), list(2))
    }

    /// Returns the finished net.
    #[must_use]
    pub fn build(self) -> Net {
        self.net
    }
}

/// The places whose uses satisfy a condition, each with weight 1.
fn places(uses: &[(PlaceId, Use)], is_wanted: impl Fn(Use) -> bool) -> impl Iterator<Item = (PlaceId, u64)> {
    uses.iter().filter(move |(_, uses)| is_wanted(*uses)).map(|&(place, _)| (place, 1))
}
