//! The transition view: markings of a safe net, one bit a place; every firing is a step.

use super::space::{Failure, StateSpace, Step};
use crate::net::{Net, PlaceId, TransitionId};

/// The reachable markings of a net.
pub struct MarkingSpace<'n> {
    net: &'n Net,
    transitions: Vec<Masks>,
    /// For each place, the transitions that are looked at if it is marked. Each transition has one such place, in its
    /// preset: the one that fewest transitions depend on.
    keyed: Vec<Vec<TransitionId>>,
    /// Transitions without preset, which are looked at always.
    unkeyed: Vec<TransitionId>,
}

/// A transition in terms of words: (word, bits).
struct Masks {
    needs: Vec<(usize, u64)>,
    takes: Vec<(usize, u64)>,
    puts: Vec<(usize, u64)>,
}

impl<'n> MarkingSpace<'n> {
    /// The space of a net.
    #[must_use]
    pub fn new(net: &'n Net) -> Self {
        let mut dependents = vec![0_usize; net.places().len()];
        let needs = net.transition_ids().flat_map(|id| net.arcs(id).preset());
        needs.for_each(|place| dependents[place.index()] += 1);
        let mut space =
            Self { net, transitions: Vec::new(), keyed: vec![Vec::new(); dependents.len()], unkeyed: Vec::new() };
        for id in net.transition_ids() {
            let arcs = net.arcs(id);
            match arcs.preset().min_by_key(|place| dependents[place.index()]) {
                Some(key) => space.keyed[key.index()].push(id),
                None => space.unkeyed.push(id),
            }
            space.transitions.push(Masks {
                needs: masks(arcs.preset()),
                takes: masks(arcs.consume.iter().copied()),
                puts: masks(arcs.produce.iter().copied()),
            });
        }
        space
    }

    /// The net.
    #[must_use]
    pub fn net(&self) -> &'n Net {
        self.net
    }

    /// Whether a place is marked in a state.
    #[must_use]
    pub fn is_marked(&self, state: &[u64], place: PlaceId) -> bool {
        state[place.index() / 64] >> (place.index() % 64) & 1 == 1
    }

    /// Whether a transition is enabled in a state.
    #[must_use]
    pub fn is_enabled(&self, state: &[u64], transition: TransitionId) -> bool {
        self.transitions[transition.index()].needs.iter().all(|&(word, bits)| state[word] & bits == bits)
    }

    /// Calls `visit` for each enabled transition with the step it makes.
    pub fn firings(&self, state: &[u64], visit: &mut dyn FnMut(TransitionId, Step<'_>)) {
        let mut next = Vec::with_capacity(state.len());
        let marked = ones(state).flat_map(|place| &self.keyed[place]);
        for &id in self.unkeyed.iter().chain(marked).filter(|&&id| self.is_enabled(state, id)) {
            let masks = &self.transitions[id.index()];
            next.clear();
            next.extend_from_slice(state);
            masks.takes.iter().for_each(|&(word, bits)| next[word] &= !bits);
            match masks.puts.iter().find(|&&(word, bits)| next[word] & bits != 0) {
                Some(&(word, bits)) => {
                    let full = word * 64 + (next[word] & bits).trailing_zeros() as usize;
                    visit(id, Step::Fails(Failure::NotSafe(PlaceId::at(full))));
                }
                None => {
                    masks.puts.iter().for_each(|&(word, bits)| next[word] |= bits);
                    visit(id, Step::To(&next));
                }
            }
        }
    }
}

impl StateSpace for MarkingSpace<'_> {
    fn words(&self) -> usize {
        self.net.places().len().div_ceil(64).max(1)
    }

    fn initial(&self, visit: &mut dyn FnMut(Step<'_>)) {
        let mut state = vec![0; self.words()];
        for place in self.net.place_ids().filter(|&place| self.net.place(place).is_marked()) {
            state[place.index() / 64] |= 1 << (place.index() % 64);
        }
        visit(Step::To(&state));
    }

    fn successors(&self, state: &[u64], visit: &mut dyn FnMut(Step<'_>)) {
        self.firings(state, &mut |_, step| visit(step));
    }
}

/// The bits of a set of places, word by word.
fn masks(places: impl Iterator<Item = PlaceId>) -> Vec<(usize, u64)> {
    let mut masks: Vec<(usize, u64)> = Vec::new();
    for place in places {
        let (word, bit) = (place.index() / 64, 1 << (place.index() % 64));
        match masks.iter_mut().find(|(w, _)| *w == word) {
            Some((_, bits)) => *bits |= bit,
            None => masks.push((word, bit)),
        }
    }
    masks
}

/// The positions of the bits that are set, ascending.
fn ones(state: &[u64]) -> impl Iterator<Item = usize> {
    state.iter().enumerate().flat_map(|(word, &bits)| {
        let mut rest = bits;
        std::iter::from_fn(move || {
            let bit = (rest != 0).then(|| rest.trailing_zeros() as usize)?;
            rest &= rest - 1;
            Some(word * 64 + bit)
        })
    })
}
