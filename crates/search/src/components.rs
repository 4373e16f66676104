//! Strongly connected components of a part of a graph.

use std::sync::atomic::AtomicBool;

use fixedbitset::FixedBitSet;

use crate::graph::Graph;
use crate::tarjan::{NONE, tarjan};

/// The strongly connected components of a part of a graph.
pub struct Components {
    /// The component of each state; [`Components::NONE`] outside the part.
    pub of: Vec<u32>,
    /// How many components there are. A component's number exceeds those of the components it leads to.
    pub count: usize,
    /// Components with a cycle: more than one state, or a state with a step to itself.
    pub cyclic: FixedBitSet,
}

impl Components {
    /// Stands for "outside the part".
    pub const NONE: u32 = NONE;

    /// Whether a state lies on a cycle within the part.
    #[must_use]
    pub fn on_cycle(&self, state: u32) -> bool {
        let component = self.of[state as usize];
        component != Self::NONE && self.cyclic.contains(component as usize)
    }
}

/// The components of the states in `part`, steps out of it left aside.
///
/// Rows are nodes too, between the states that have them and those they hold, so that a row is gone through once however
/// many states share it. A component with a cycle then holds a row, and one without does not hold more than one node.
#[must_use]
pub fn components(graph: &Graph, part: &FixedBitSet) -> Components {
    let none = || Components { of: Vec::new(), count: 0, cyclic: FixedBitSet::new() };
    components_until(graph, part, &AtomicBool::new(false)).unwrap_or_else(none)
}

/// As [`components`]. Nothing if `stopping` is set meanwhile.
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
