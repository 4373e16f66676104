//! Connected components of a net as a graph of places and transitions.

use petgraph::algo::{connected_components, kosaraju_scc};
use petgraph::graph::{DiGraph, NodeIndex};

use super::flow::Flow;

/// Numbers of connected components of a net; 0 for a net without nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Components {
    /// Number of weakly connected components.
    pub weakly: usize,
    /// Number of strongly connected components.
    pub strongly: usize,
}

impl Components {
    /// Counts the components of a net.
    #[must_use]
    pub fn of(flow: &Flow) -> Self {
        let (places, transitions) = (flow.places(), flow.transitions());
        let arcs = (0..transitions).map(|id| flow.inputs[id].len() + flow.outputs[id].len()).sum();
        let mut graph: DiGraph<(), ()> = DiGraph::with_capacity(places + transitions, arcs);
        (0..places + transitions).for_each(|_| _ = graph.add_node(()));
        for id in 0..transitions {
            let node = NodeIndex::new(places + id);
            flow.inputs[id].iter().for_each(|&place| _ = graph.add_edge(NodeIndex::new(place as usize), node, ()));
            flow.outputs[id].iter().for_each(|&place| _ = graph.add_edge(node, NodeIndex::new(place as usize), ()));
        }
        Self { weakly: connected_components(&graph), strongly: kosaraju_scc(&graph).len() }
    }
}
