//! Control-flow graph of an instruction list. A parenthesis is one node: no control passes its ends.

use std::collections::BTreeMap;

use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::visit::Dfs;

use crate::syntax::ast::{Condition, Instruction, Operation};

/// Control-flow graph: node `i` is instruction `i`; one more node stands for the end of the program.
pub type ControlFlow = DiGraph<(), ()>;

/// First instruction of each label, by the label's key.
pub fn labels(body: &[Instruction]) -> BTreeMap<String, usize> {
    let mut labels = BTreeMap::new();
    for (i, instruction) in body.iter().enumerate() {
        if let Some(label) = &instruction.label {
            labels.entry(label.key()).or_insert(i);
        }
    }
    labels
}

/// Builds the graph of a list. A jump to a label that does not exist, which is reported elsewhere, goes to the end.
pub fn graph(body: &[Instruction]) -> ControlFlow {
    let labels = labels(body);
    let end = body.len();
    let mut graph = ControlFlow::with_capacity(end + 1, end * 2);
    let nodes: Vec<NodeIndex> = (0..=end).map(|_| graph.add_node(())).collect();
    for (i, instruction) in body.iter().enumerate() {
        let (condition, target) = match &instruction.operation {
            Some(Operation::Jump { condition, target }) => {
                (*condition, labels.get(&target.key()).copied().unwrap_or(end))
            }
            Some(Operation::Return { condition }) => (*condition, end),
            _ => {
                graph.add_edge(nodes[i], nodes[i + 1], ());
                continue;
            }
        };
        graph.add_edge(nodes[i], nodes[target], ());
        if condition != Condition::Always {
            graph.update_edge(nodes[i], nodes[i + 1], ());
        }
    }
    graph
}

/// Whether the graph is exact: every line can be read, and every jump has its label.
pub fn is_known(body: &[Instruction]) -> bool {
    let labels = labels(body);
    body.iter().all(|instruction| match &instruction.operation {
        Some(Operation::Jump { target, .. }) => labels.contains_key(&target.key()),
        Some(Operation::Broken) => false,
        _ => true,
    })
}

/// Reachable nodes, as one flag per node.
pub fn reachable(graph: &ControlFlow) -> Vec<bool> {
    let mut reachable = vec![false; graph.node_count()];
    let mut search = Dfs::new(graph, NodeIndex::new(0));
    while let Some(node) = search.next(graph) {
        reachable[node.index()] = true;
    }
    reachable
}
