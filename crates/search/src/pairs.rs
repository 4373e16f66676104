//! The product of a graph with a nondeterministic automaton that follows its paths.

use rustc_hash::FxHashMap;

use crate::budget::{Budget, Stop};
use crate::graph::Graph;

/// Nondeterministic automaton that reads the states along the paths of a graph. Its states are called modes.
pub trait Follower {
    /// Calls `visit` with each mode in which the automaton can enter a state from mode `from`; `None` stands for the
    /// beginning. The modes depend on `from` only by its [`Follower::class`].
    fn enter(&self, from: Option<u32>, state: u32, visit: &mut dyn FnMut(u32));

    /// Class of a mode. Modes of the same class have the same successors.
    fn class(&self, mode: u32) -> u32;
}

/// Product of a graph and a [`Follower`].
pub struct Pairs {
    /// Reachable pairs and the steps between them. Steps that are unknown in the original graph are unknown here too.
    pub graph: Graph,
    /// For each state of the product, the state of the original graph and the mode.
    pub pairs: Vec<(u32, u32)>,
}

/// Computes the product.
///
/// # Errors
/// The limit that would be exceeded: there are more pairs than the budget has states, or they take more memory.
pub fn followed(graph: &Graph, follower: &dyn Follower, budget: Budget) -> Result<Pairs, Stop> {
    let mut pairs = Numbering::default();
    for &state in graph.initial() {
        follower.enter(None, state, &mut |mode| _ = pairs.number(state, mode));
    }
    let initial = (0..pairs.list.len() as u32).collect();
    // Pairs share a row if their states do and their modes are of the same class.
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

/// Pairs of a state and a mode, numbered in the order of discovery.
#[derive(Default)]
struct Numbering {
    list: Vec<(u32, u32)>,
    numbers: FxHashMap<(u32, u32), u32>,
}

impl Numbering {
    /// Approximate memory of a pair, in bytes.
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
