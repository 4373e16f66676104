//! Automata over bits: control that remembers something, like a carry, while it goes from bit to bit.

use std::collections::VecDeque;
use std::hash::Hash;

use rustc_hash::FxHashMap;

use super::subnet::Subnet;
use super::weaver::Changes;
use petril_net::net::PlaceId;

/// What an automaton does in a state.
pub enum Stage<S> {
    /// It is done, and control goes on there.
    Leave(PlaceId),
    /// Nothing; it is in this state already.
    Same(S),
    /// It goes on in a state for each alternative of bits.
    Branch(Vec<(Changes, S)>),
}

impl Subnet<'_> {
    /// Adds a place for each state that the automaton can come to from `start`, which is `from`, and a transition for each
    /// alternative. `rule` says what happens in a state; it is asked at least once for each.
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

    /// Follows a state to one where something happens.
    fn settle<S>(&mut self, mut state: S, rule: &mut impl FnMut(&mut Self, &S) -> Stage<S>) -> (S, Stage<S>) {
        loop {
            match rule(self, &state) {
                Stage::Same(other) => state = other,
                stage => return (state, stage),
            }
        }
    }
}
