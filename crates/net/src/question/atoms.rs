//! State formulas evaluated on all explored states in one parallel pass.

use std::sync::atomic::{AtomicBool, Ordering};

use fixedbitset::FixedBitSet;
use rayon::prelude::*;

use super::condition::Condition;
use crate::engine::{Exploration, View};
use crate::net::{PlaceId, TransitionId};
use petril_base::VarId;
use petril_logic::{Atom, Bound, Dag, Node, Valuation};

/// Atomic propositions with the sets of states that satisfy them.
pub(super) struct Atoms<'d> {
    formulas: Vec<&'d Bound>,
    sets: Vec<FixedBitSet>,
}

const BITS: usize = usize::BITS as usize;

/// Words of each bit set that one thread computes at a time.
const BLOCK: usize = 128;

impl<'d> Atoms<'d> {
    /// Evaluates all state formulas of the DAGs; `None` if `stopping` is set meanwhile.
    pub(super) fn of(
        exploration: &Exploration,
        dags: impl Iterator<Item = &'d Dag>,
        stopping: &AtomicBool,
    ) -> Option<Self> {
        let mut formulas: Vec<&Bound> = Vec::new();
        for node in dags.flat_map(Dag::nodes) {
            if let Node::State { formula, .. } = node
                && !formulas.contains(&formula)
            {
                formulas.push(formula);
            }
        }
        let mut places: Vec<PlaceId> = Vec::new();
        let mut note = |atom| places.extend(if let Atom::Place(place) = atom { Some(place) } else { None });
        formulas.iter().for_each(|formula| formula.for_each_atom(&mut note));
        places.sort_unstable();
        places.dedup();
        let states = exploration.kept();
        let words = states.div_ceil(BITS);
        let blocks: Vec<Vec<usize>> = (0..words.div_ceil(BLOCK))
            .into_par_iter()
            .map(|block| {
                let states = block * BLOCK * BITS..states.min((block + 1) * BLOCK * BITS);
                if stopping.load(Ordering::Relaxed) {
                    Vec::new()
                } else {
                    truths(exploration, &formulas, &places, states)
                }
            })
            .collect();
        if stopping.load(Ordering::Relaxed) {
            return None;
        }
        let set = |formula: usize| {
            let words = blocks.iter().flat_map(|block| {
                let length = block.len() / formulas.len();
                block[formula * length..(formula + 1) * length].iter().copied()
            });
            FixedBitSet::with_capacity_and_blocks(states, words)
        };
        let sets = (0..formulas.len()).map(set).collect();
        Some(Self { formulas, sets })
    }

    /// Set of states that satisfy a formula or its negation, with capacity `room`; the states beyond those kept are not
    /// in it.
    pub(super) fn holding(&self, formula: &Bound, negated: bool, room: usize) -> FixedBitSet {
        let known = self.formulas.iter().position(|known| *known == formula);
        let mut set = known.map_or_else(FixedBitSet::new, |position| self.sets[position].clone());
        if negated {
            set.toggle_range(..);
        }
        set.grow(room);
        set
    }
}

/// Truth values of each formula on a range of states, packed into words.
fn truths(
    exploration: &Exploration,
    formulas: &[&Bound],
    places: &[PlaceId],
    states: std::ops::Range<usize>,
) -> Vec<usize> {
    let words = states.len().div_ceil(BITS);
    let mut truths = vec![0; words * formulas.len()];
    let mut tokens = vec![0; places.last().map_or(0, |place| place.index() + 1)];
    let mut reader = exploration.reader(places.iter().map(|place| place.index()));
    let conditions: Vec<Condition<'_>> = formulas.iter().map(|formula| Condition::of(formula)).collect();
    exploration.for_states(states.start as u32..states.end as u32, |state, view| {
        reader.read(view, &mut tokens);
        let seen = Unpacked { tokens: &tokens, view };
        let at = state as usize - states.start;
        for (condition, truths) in conditions.iter().zip(truths.chunks_exact_mut(words)) {
            let holds = condition.holds(&tokens, &seen);
            truths[at / BITS] |= usize::from(holds) << (at % BITS);
        }
    });
    truths
}

/// A state whose token counts, as far as needed, have been unpacked.
struct Unpacked<'v> {
    tokens: &'v [u64],
    view: &'v View<'v>,
}

impl Valuation for Unpacked<'_> {
    fn value(&self, _: VarId) -> u64 {
        0
    }

    fn is_marked(&self, place: PlaceId) -> bool {
        self.tokens(place) > 0
    }

    fn tokens(&self, place: PlaceId) -> u64 {
        self.tokens[place.index()]
    }

    fn is_enabled(&self, transition: TransitionId) -> bool {
        self.view.is_enabled(transition.index())
    }

    fn is_deadlock(&self) -> bool {
        self.view.is_deadlock()
    }
}
