//! The product of a graph with something that follows its paths, in one of several ways in each state.

use rustc_hash::FxHashMap;

use crate::budget::{Budget, Stop};
use crate::graph::Graph;

/// Something that follows the paths of a graph and is in some mode in each of their states.
pub trait Follower {
    /// Calls `visit` for each mode in which it can enter a state, coming from a state where it was in mode `from`; `None` stands for
    /// the beginning. They depend on [`Follower::class`] of the mode alone.
    fn enter(&self, from: Option<u32>, state: u32, visit: &mut dyn FnMut(u32));

    /// Modes of the same class go on in the same way.
    fn class(&self, mode: u32) -> u32;
}

/// The paths of a graph together with the modes of what follows them.
pub struct Pairs {
    /// The pairs that are reachable, and the steps between them. Where the graph's own steps are not all known, neither are these.
    pub graph: Graph,
    /// For each of its states the state of the graph and the mode.
    pub pairs: Vec<(u32, u32)>,
}

/// The product; or the limit that it would go beyond.
///
/// # Errors
/// There are more pairs than the budget has states, or they take more memory.
pub fn followed(graph: &Graph, follower: &dyn Follower, budget: Budget) -> Result<Pairs, Stop> {
    let mut pairs = Numbering::default();
    for &state in graph.initial() {
        follower.enter(None, state, &mut |mode| _ = pairs.number(state, mode));
    }
    let initial = (0..pairs.list.len() as u32).collect();
    // Pairs share a row where their states do and their modes go on in the same way.
    let mut rows: FxHashMap<(Option<u32>, u32), u32> = FxHashMap::default();
    let (mut row_of, mut starts, mut targets): (Vec<u32>, Vec<u64>, Vec<u32>) = (Vec::new(), vec![0], Vec::new());
    while let Some(&(state, mode)) = pairs.list.get(row_of.len()) {
        let next = rows.len() as u32;
        let row = *rows.entry((graph.row_of(state), follower.class(mode))).or_insert(next);
        row_of.push(row);
        if row < next {
            continue;
        }
        for &target in graph.successors(state) {
            follower.enter(Some(mode), target, &mut |mode| targets.push(pairs.number(target, mode)));
        }
        starts.push(targets.len() as u64);
        if pairs.list.len() as u64 > budget.states.min(u64::from(u32::MAX >> 1)) {
            return Err(Stop::States(budget.states));
        }
        if (targets.len() * 4 + pairs.list.len() * Numbering::BYTES) as u64 > budget.bytes {
            return Err(Stop::Bytes(budget.bytes));
        }
    }
    Ok(Pairs { graph: Graph::of_pairs(initial, row_of, starts, targets), pairs: pairs.list })
}

/// Pairs of a state and a mode, numbered as they are met.
#[derive(Default)]
struct Numbering {
    list: Vec<(u32, u32)>,
    numbers: FxHashMap<(u32, u32), u32>,
}

impl Numbering {
    /// About what each takes.
    const BYTES: usize = 48;

    fn number(&mut self, state: u32, mode: u32) -> u32 {
        let next = self.list.len() as u32;
        let number = *self.numbers.entry((state, mode)).or_insert(next);
        if number == next {
            self.list.push((state, mode));
        }
        number
    }
}
