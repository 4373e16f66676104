//! The arcs of a net, stored contiguously, since a net may have millions.

use super::{PlaceId, TransitionId};

/// Arcs of a transition, with loops turned into read arcs. In an ordinary net every arc has weight 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arcs<'n> {
    /// Preset without the read places: firing takes tokens from each.
    pub consume: &'n [PlaceId],
    /// Postset without the read places: firing puts tokens on each.
    pub produce: &'n [PlaceId],
    /// Read places: they must be marked and stay marked.
    pub read: &'n [PlaceId],
}

/// Weights of a transition's arcs, list by list; empty where all are 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Weights<'n> {
    pub consume: &'n [u64],
    pub produce: &'n [u64],
    pub read: &'n [u64],
}

impl<'n> Arcs<'n> {
    /// The preset: the places a token is taken from, then those that are read.
    pub fn preset(self) -> impl Iterator<Item = PlaceId> + Clone + 'n {
        self.consume.iter().chain(self.read).copied()
    }
}

/// Arcs of all transitions, by position.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct ArcTable {
    places: Vec<PlaceId>,
    /// Weight of each arc; empty while all are 1.
    weights: Vec<u64>,
    /// End offsets of each transition's three lists. A list begins where the one before it ends.
    ends: Vec<[u32; 3]>,
}

impl ArcTable {
    /// Adds the arcs of the next transition, each list in ascending order, with their weights.
    pub fn push(
        &mut self,
        consume: impl Iterator<Item = (PlaceId, u64)>,
        produce: impl Iterator<Item = (PlaceId, u64)>,
        read: impl Iterator<Item = (PlaceId, u64)>,
    ) -> TransitionId {
        let ends = [self.extend(consume), self.extend(produce), self.extend(read)];
        self.ends.push(ends);
        TransitionId::at(self.ends.len() - 1)
    }

    /// Adds a list, and returns the offset of its end.
    fn extend(&mut self, arcs: impl Iterator<Item = (PlaceId, u64)>) -> u32 {
        for (place, weight) in arcs {
            if weight != 1 && self.weights.is_empty() {
                self.weights.resize(self.places.len(), 1);
            }
            if weight != 1 || !self.weights.is_empty() {
                self.weights.push(weight);
            }
            self.places.push(place);
        }
        u32::try_from(self.places.len()).expect("a net has fewer than 2³² arcs")
    }

    fn lists<'n, T>(&self, of: &'n [T], transition: TransitionId) -> [&'n [T]; 3] {
        let position = transition.index();
        let start = position.checked_sub(1).map_or(0, |before| self.ends[before][2]);
        let [consumed, produced, read] = self.ends[position];
        let list = |from: u32, to: u32| of.get(from as usize..to as usize).unwrap_or_default();
        [list(start, consumed), list(consumed, produced), list(produced, read)]
    }

    pub fn get(&self, transition: TransitionId) -> Arcs<'_> {
        let [consume, produce, read] = self.lists(&self.places, transition);
        Arcs { consume, produce, read }
    }

    pub fn weights(&self, transition: TransitionId) -> Weights<'_> {
        let [consume, produce, read] = self.lists(&self.weights, transition);
        Weights { consume, produce, read }
    }

    /// Number of transitions.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Number of arcs; a read arc counts as one.
    pub fn count(&self) -> usize {
        self.places.len()
    }
}
