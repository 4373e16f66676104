//! Strongly connected components of a subgraph.

use std::sync::atomic::AtomicBool;

use fixedbitset::FixedBitSet;

use crate::graph::Graph;
use crate::tarjan::{NONE, tarjan};

/// Strongly connected components of the subgraph of some states.
pub struct Components {
    /// Component of each state; [`Components::NONE`] outside the part.
    pub of: Vec<u32>,
    /// Number of components. They are numbered in reverse topological order: a component's number exceeds those it
    /// leads to.
    pub count: usize,
    /// Components with a cycle: more than one state, or a state with a step to itself.
    pub cyclic: FixedBitSet,
}

impl Components {
    /// Component number of states outside the part.
    pub const NONE: u32 = NONE;

    /// Whether a state lies on a cycle within the part.
    #[must_use]
    pub fn on_cycle(&self, state: u32) -> bool {
        let component = self.of[state as usize];
        component != Self::NONE && self.cyclic.contains(component as usize)
    }
}

/// Computes the components of the states in `part`, ignoring steps out of it.
///
/// Rows are nodes too, between the states that have them and their successors, so that a shared row is traversed only
/// once. A component with a cycle then contains a row, and one without a cycle is a single node.
#[must_use]
pub fn components(graph: &Graph, part: &FixedBitSet) -> Components {
    let none = || Components { of: Vec::new(), count: 0, cyclic: FixedBitSet::new() };
    components_until(graph, part, &AtomicBool::new(false)).unwrap_or_else(none)
}

/// Computes components as [`components`] does. `None` if `stopping` is set meanwhile.
#[must_use]
pub fn components_until(graph: &Graph, part: &FixedBitSet, stopping: &AtomicBool) -> Option<Components> {
    let n = graph.len();
    let row_nodes: Vec<u32> = graph.ids().filter_map(|state| graph.row_of(state)).map(|row| n as u32 + row).collect();
    let mut present = part.clone();
    present.grow(n + graph.rows());
    present.insert_range(n..);
    let successors = |node: u32| match (node as usize).checked_sub(n) {
        Some(row) => graph.row(row as u32),
        None => row_nodes.get(node as usize).map_or(&[][..], std::slice::from_ref),
    };
    let (mut of, count) = tarjan(n + graph.rows(), &present, successors, stopping)?;
    let mut cyclic = FixedBitSet::with_capacity(count);
    for state in part.ones() {
        let row = row_nodes.get(state).map(|&row| of[row as usize]);
        if row == Some(of[state]) {
            cyclic.insert(of[state] as usize);
        }
    }
    of.truncate(n);
    Some(Components { of, count, cyclic })
}
