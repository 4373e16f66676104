//! The arcs of a net, one after another in one piece of memory: a net may have millions.

use super::{PlaceId, TransitionId};

/// The arcs of a transition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arcs<'n> {
    /// Preset without read places: a token is taken from each.
    pub consume: &'n [PlaceId],
    /// Postset: a token is put on each.
    pub produce: &'n [PlaceId],
    /// Places that must be marked and stay so.
    pub read: &'n [PlaceId],
}

impl<'n> Arcs<'n> {
    /// The places that must be marked: those a token is taken from, then those that are read.
    pub fn preset(self) -> impl Iterator<Item = PlaceId> + Clone + 'n {
        self.consume.iter().chain(self.read).copied()
    }
}

/// The arcs of all transitions, by position.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct ArcTable {
    places: Vec<PlaceId>,
    /// Where the three lists of each transition end. Each begins where the one before it ends.
    ends: Vec<[u32; 3]>,
}

impl ArcTable {
    /// Adds the arcs of the next transition, each list in ascending order.
    pub fn push(
        &mut self,
        consume: impl Iterator<Item = PlaceId>,
        produce: impl Iterator<Item = PlaceId>,
        read: impl Iterator<Item = PlaceId>,
    ) -> TransitionId {
        self.places.extend(consume);
        let consumed = self.end();
        self.places.extend(produce);
        let produced = self.end();
        self.places.extend(read);
        self.ends.push([consumed, produced, self.end()]);
        TransitionId::at(self.ends.len() - 1)
    }

    fn end(&self) -> u32 {
        u32::try_from(self.places.len()).expect("a net has fewer than 2³² arcs")
    }

    pub fn get(&self, transition: TransitionId) -> Arcs<'_> {
        let position = transition.index();
        let start = position.checked_sub(1).map_or(0, |before| self.ends[before][2]);
        let [consumed, produced, read] = self.ends[position];
        let list = |from: u32, to: u32| &self.places[from as usize..to as usize];
        Arcs { consume: list(start, consumed), produce: list(consumed, produced), read: list(produced, read) }
    }

    /// How many transitions there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// How many arcs there are, a read arc being one.
    pub fn count(&self) -> usize {
        self.places.len()
    }
}
