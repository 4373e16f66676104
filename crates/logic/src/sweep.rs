//! Least fixpoints by sweeps over the states.
//!
//! States are numbered by their distance, so a sweep from the last to the first follows most steps backwards, and a few
//! sweeps are enough; only steps to a lower number need another one. A sweep reads the rows in order, and the set, one
//! bit per state, stays in cache. So rows of predecessors, which would double the graph, are not needed. If sweeps do
//! not converge soon, predecessors are used after all.

use std::sync::atomic::{AtomicBool, Ordering};

use fixedbitset::FixedBitSet;

use petril_search::Graph;

/// Monotone predicate: whether a state joins a set, depending on which of its successors the set contains. True for
/// every larger set too, and for all states that share the row.
pub(super) type Joins<'a> = &'a dyn Fn(&FixedBitSet, u32) -> bool;

const BITS: usize = usize::BITS as usize;

/// Number of full sweeps that are cheaper than computing rows of predecessors.
const SWEEPS: usize = 24;

/// Computes the least fixpoint: adds states of `within` to a set as long as any joins. If `stopping` is set meanwhile,
/// some may be missing.
pub(super) fn grow(
    graph: &Graph,
    mut set: FixedBitSet,
    within: &FixedBitSet,
    stopping: &AtomicBool,
    joins: Joins<'_>,
) -> FixedBitSet {
    let mut patience = graph.len().saturating_mul(SWEEPS);
    let mut shared = Shared::of(graph);
    loop {
        let (joined, tried) = sweep(&mut set, within, stopping, &mut |set, state| match &mut shared {
            Some(shared) => shared.joins(set, state, joins),
            None => joins(set, state),
        });
        if joined == 0 || stopping.load(Ordering::Relaxed) {
            return set;
        }
        patience = patience.saturating_sub(tried);
        shared.iter_mut().for_each(|shared| shared.failed.clear());
        if patience == 0 {
            follow(graph, &mut set, within, stopping, joins);
            return set;
        }
    }
}

/// Results for shared rows, so that each is traversed only once in a sweep.
struct Shared<'g> {
    graph: &'g Graph,
    joined: FixedBitSet,
    failed: FixedBitSet,
}

impl<'g> Shared<'g> {
    /// Makes empty results; `None` if no rows are shared.
    fn of(graph: &'g Graph) -> Option<Self> {
        let none = FixedBitSet::with_capacity(graph.rows());
        (graph.rows() < graph.expanded()).then(|| Self { graph, joined: none.clone(), failed: none })
    }

    fn joins(&mut self, set: &FixedBitSet, state: u32, joins: Joins<'_>) -> bool {
        let Some(row) = self.graph.row_of(state).map(|row| row as usize) else { return joins(set, state) };
        if self.joined.contains(row) || self.failed.contains(row) {
            return self.joined.contains(row);
        }
        let joined = joins(set, state);
        let known = if joined { &mut self.joined } else { &mut self.failed };
        known.insert(row);
        joined
    }
}

/// Tries every state of `within` once, the last first. Returns the number of states that joined, and the cost.
fn sweep(
    set: &mut FixedBitSet,
    within: &FixedBitSet,
    stopping: &AtomicBool,
    joins: &mut dyn FnMut(&FixedBitSet, u32) -> bool,
) -> (usize, usize) {
    let (mut joined, mut tried) = (0, within.as_slice().len());
    for (block, &inside) in within.as_slice().iter().enumerate().rev() {
        if block % 1024 == 0 && stopping.load(Ordering::Relaxed) {
            break;
        }
        let mut candidates = inside & !set.as_slice()[block];
        tried += candidates.count_ones() as usize;
        while candidates != 0 {
            let bit = BITS - 1 - candidates.leading_zeros() as usize;
            candidates ^= 1 << bit;
            let state = block * BITS + bit;
            if joins(set, state as u32) {
                set.insert(state);
                joined += 1;
            }
        }
    }
    (joined, tried)
}

/// Computes the least fixpoint by following steps backwards from states that have joined.
fn follow(graph: &Graph, set: &mut FixedBitSet, within: &FixedBitSet, stopping: &AtomicBool, joins: Joins<'_>) {
    let mut work: Vec<u32> = Vec::new();
    let enter = |set: &mut FixedBitSet, work: &mut Vec<u32>, state: u32| {
        if within.contains(state as usize) && !set.contains(state as usize) && joins(set, state) {
            set.insert(state as usize);
            work.push(state);
        }
    };
    graph.ids().for_each(|state| enter(set, &mut work, state));
    while let Some(state) = work.pop() {
        if stopping.load(Ordering::Relaxed) {
            return;
        }
        for &row in graph.rows_to(state) {
            graph.members(row).iter().for_each(|&before| enter(set, &mut work, before));
        }
    }
}
