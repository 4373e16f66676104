//! Nets are built place by place and transition by transition, then never changed.

use super::{Arcs, Net, PlaceId, TransitionId};

/// Builds a [`Net`].
///
/// Names are taken as they are; whoever builds sees to it that they are unique among places and among transitions.
#[derive(Clone, Debug)]
pub struct Builder {
    net: Net,
    /// What the transition in the making does with its places; kept for its memory.
    uses: Vec<(PlaceId, Use)>,
}

/// What a transition does with a place, as bits.
type Use = u8;
const CONSUME: Use = 1;
const PRODUCE: Use = 2;
const READ: Use = 4;
/// The token is taken and put back.
const LOOP: Use = CONSUME | PRODUCE;

impl Builder {
    /// An empty net.
    pub fn new(name: impl Into<String>) -> Self {
        Self { net: Net::empty(name.into()), uses: Vec::new() }
    }

    /// Adds a place.
    pub fn place(&mut self, name: impl AsRef<str>, marked: bool) -> PlaceId {
        self.net.place_names.push(name.as_ref());
        self.net.marked.push(marked);
        PlaceId::at(self.net.marked.len() - 1)
    }

    /// The name of a place that has been added.
    #[must_use]
    pub fn place_name(&self, place: PlaceId) -> &str {
        self.net.place_names.get(place.index())
    }

    /// Adds a transition. A place it both takes from and puts to becomes a place it reads; a place it reads and also
    /// takes from is only taken from, since that asks for the same token.
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

    /// The finished net.
    #[must_use]
    pub fn build(self) -> Net {
        self.net
    }
}

/// The places of certain uses.
fn places(uses: &[(PlaceId, Use)], is_wanted: impl Fn(Use) -> bool) -> impl Iterator<Item = PlaceId> {
    uses.iter().filter(move |(_, uses)| is_wanted(*uses)).map(|&(place, _)| place)
}
