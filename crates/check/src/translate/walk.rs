//! Automata over bits: control that remembers a state, like a carry, while it goes from bit to bit.

use std::collections::VecDeque;
use std::hash::Hash;

use rustc_hash::FxHashMap;

use super::subnet::Subnet;
use super::weaver::Changes;
use petril_net::net::PlaceId;

/// Action of an automaton in a state.
pub enum Stage<S> {
    /// Leave the automaton; control goes on at this place.
    Leave(PlaceId),
    /// Be in this state instead, without a transition.
    Same(S),
    /// Go on in a state for each alternative of bits.
    Branch(Vec<(Changes, S)>),
}

impl Subnet<'_> {
    /// Adds the subnet of an automaton: a place for each state reachable from `start`, whose place is `from`, and a
    /// transition for each alternative. `rule` gives the action in a state, and is called at least once for each.
    pub fn walk<S: Eq + Hash + Clone>(
        &mut self,
        from: PlaceId,
        start: S,
        mut rule: impl FnMut(&mut Self, &S) -> Stage<S>,
    ) {
        let mut places: FxHashMap<S, PlaceId> = FxHashMap::default();
        let mut queue = VecDeque::new();
        match self.settle(start, &mut rule) {
            (_, Stage::Leave(to)) => self.step(from, to, &[]),
            (state, stage) => {
                places.insert(state, from);
                queue.push_back((from, stage));
            }
        }
        while let Some((at, stage)) = queue.pop_front() {
            let Stage::Branch(alternatives) = stage else { continue };
            for (changes, state) in alternatives {
                let to = match places.get(&state) {
                    Some(&known) => known,
                    None => match self.settle(state, &mut rule) {
                        (_, Stage::Leave(to)) => to,
                        (state, stage) => *places.entry(state).or_insert_with(|| {
                            let new = self.within();
                            queue.push_back((new, stage));
                            new
                        }),
                    },
                };
                self.step(at, to, &changes);
            }
        }
    }

    /// Follows [`Stage::Same`] to a state with another action.
    fn settle<S>(&mut self, mut state: S, rule: &mut impl FnMut(&mut Self, &S) -> Stage<S>) -> (S, Stage<S>) {
        loop {
            match rule(self, &state) {
                Stage::Same(other) => state = other,
                stage => return (state, stage),
            }
        }
    }
}
