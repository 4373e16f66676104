//! Topological order of definitions, and cyclic definitions.

use std::collections::hash_map::Entry;
use std::collections::{HashMap, VecDeque};

use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use super::Resolver;
use crate::sif::{Kind, SignalId};
use petril_base::diagnostic::{Code, Diagnostic};

impl Resolver<'_> {
    /// Orders definitions after those they use; reports cyclic definitions.
    pub(super) fn put_in_order(&mut self) {
        let mut graph: DiGraph<(), ()> = DiGraph::new();
        let signals = &self.specification.signals;
        for _ in signals {
            graph.add_node(());
        }
        let node = |id: SignalId| NodeIndex::new(id.0);
        for id in (0..signals.len()).map(SignalId) {
            let Kind::Defined { formula, .. } = &signals[id.0].kind else { continue };
            for used in formula.signals() {
                graph.add_edge(node(id), node(used), ());
            }
        }
        // Components come in topological order: each after those it leads to.
        let components = kosaraju_scc(&graph);
        let order = components.iter().flatten().map(|node| SignalId(node.index()));
        self.specification.order = order.filter(|id| matches!(signals[id.0].kind, Kind::Defined { .. })).collect();
        let is_cycle = |members: &&Vec<NodeIndex>| members.len() > 1 || graph.contains_edge(members[0], members[0]);
        let cycles: Vec<Vec<SignalId>> = components
            .iter()
            .filter(is_cycle)
            .map(|members| cycle(&graph, members).into_iter().map(|node| SignalId(node.index())).collect())
            .collect();
        for cycle in cycles {
            let names: Vec<&str> = cycle.iter().chain(cycle.first()).map(|id| self.specification.name(*id)).collect();
            let message = format!("`{}` is defined by way of itself: {}", names[0], names.join(" -> "));
            let equation = |id: SignalId| match &self.specification.signal(id).kind {
                Kind::Defined { place, .. } => *place,
                Kind::Input { .. } => self.specification.signal(id).place,
            };
            let place = equation(cycle[0]);
            let mut diagnostic = Diagnostic::new(Code::SifCycle, place.span, message);
            for &id in cycle.iter().skip(1).take(5) {
                let text = format!("`{}` is defined here", self.specification.name(id));
                diagnostic = self.with(diagnostic, place, equation(id), &text);
            }
            let help =
                "what is remembered from one scan to the next is said by `latched until` where the output is declared";
            self.report(place, diagnostic.help(help));
        }
    }
}

/// A shortest cycle through the first declared member of a component.
fn cycle(graph: &DiGraph<(), ()>, members: &[NodeIndex]) -> Vec<NodeIndex> {
    let Some(&first) = members.iter().min() else { return Vec::new() };
    let mut from: HashMap<NodeIndex, NodeIndex> = HashMap::new();
    let mut queue = VecDeque::from([first]);
    while let Some(node) = queue.pop_front() {
        let mut next: Vec<NodeIndex> = graph.neighbors(node).filter(|next| members.contains(next)).collect();
        next.sort_unstable();
        for next in next {
            if next == first {
                let mut path = vec![node];
                while let Some(&before) = path.last().and_then(|node| from.get(node)) {
                    path.push(before);
                }
                path.reverse();
                return path;
            }
            if let Entry::Vacant(entry) = from.entry(next) {
                entry.insert(node);
                queue.push_back(next);
            }
        }
    }
    vec![first]
}
