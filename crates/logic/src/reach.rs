//! Backward reachability on known steps.

use std::sync::atomic::AtomicBool;

use fixedbitset::FixedBitSet;
use petril_search::Graph;

use super::sweep::grow;

/// States from which known steps lead to a set. If `stopping` is set meanwhile, some may be missing.
#[must_use]
pub fn leading_to(graph: &Graph, set: &FixedBitSet, stopping: &AtomicBool) -> FixedBitSet {
    let mut all = FixedBitSet::with_capacity(graph.len());
    all.insert_range(..);
    leading_through(graph, &all, set, stopping)
}

/// States from which known steps lead through states with f to a state with g. If `stopping` is set meanwhile, some may be missing.
pub(super) fn leading_through(graph: &Graph, f: &FixedBitSet, g: &FixedBitSet, stopping: &AtomicBool) -> FixedBitSet {
    let some = |set: &FixedBitSet, row: &[u32]| row.iter().any(|&next| set.contains(next as usize));
    grow(graph, g.clone(), f, stopping, &|set, state| some(set, graph.successors(state)))
}
