//! Nets are built place by place and transition by transition, then never changed.

use super::{Net, Place, PlaceId, Transition, TransitionId};

/// The arcs of a transition.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Arcs {
    /// Preset without read places: a token is taken from each.
    pub consume: Vec<PlaceId>,
    /// Postset: a token is put on each.
    pub produce: Vec<PlaceId>,
    /// Places that must be marked and stay so.
    pub read: Vec<PlaceId>,
}

/// Builds a [`Net`].
///
/// Names are taken as they are; whoever builds sees to it that they are unique among places and among transitions.
#[derive(Clone, Debug)]
pub struct Builder {
    net: Net,
}

impl Builder {
    /// An empty net.
    pub fn new(name: impl Into<String>) -> Self {
        Self { net: Net { name: name.into(), places: Vec::new(), transitions: Vec::new() } }
    }

    /// Adds a place.
    pub fn place(&mut self, name: impl Into<String>, marked: bool) -> PlaceId {
        self.net.places.push(Place { name: name.into(), marked });
        PlaceId::at(self.net.places.len() - 1)
    }

    /// The name of a place that has been added.
    #[must_use]
    pub fn place_name(&self, place: PlaceId) -> &str {
        &self.net.place(place).name
    }

    /// Adds a transition. A place it both takes from and puts to becomes a place it reads; a place it reads and also
    /// takes from is only taken from, since that asks for the same token.
    pub fn transition(&mut self, name: impl Into<String>, arcs: Arcs) -> TransitionId {
        let sorted = |mut list: Vec<PlaceId>| {
            list.sort_unstable();
            list.dedup();
            list
        };
        let has = |list: &[PlaceId], place: &PlaceId| list.binary_search(place).is_ok();
        let (mut consume, mut produce, mut read) = (sorted(arcs.consume), sorted(arcs.produce), sorted(arcs.read));
        read.retain(|place| !has(&consume, place));
        let loops: Vec<PlaceId> = consume.iter().copied().filter(|place| has(&produce, place)).collect();
        consume.retain(|place| !has(&loops, place));
        produce.retain(|place| !has(&loops, place));
        read.extend(loops);
        let read = sorted(read);
        self.net.transitions.push(Transition { name: name.into(), arcs: Arcs { consume, produce, read } });
        TransitionId::at(self.net.transitions.len() - 1)
    }

    /// The finished net.
    #[must_use]
    pub fn build(self) -> Net {
        self.net
    }
}
