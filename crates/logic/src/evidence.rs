//! Evidence that a node holds in a state: a shortest path or lasso, if a single path can show it.
//!
//! A node under E is shown by a path; a node under A is only claimed, at the state where it holds.

use std::collections::BTreeMap;
use std::rc::Rc;

use fixedbitset::FixedBitSet;

use super::dag::{Dag, Node, NodeId};
use super::fairness::Fairness;
use super::formula::Quantifier;
use super::label::Labels;
use super::lasso::lasso;
use petril_search::Graph;

/// A path through the graph, with the nodes claimed along it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Evidence {
    /// States of the path.
    pub states: Vec<u32>,
    /// Position to which the last state steps back, for a lasso.
    pub loop_start: Option<usize>,
    /// Claims in the order of the path.
    pub claims: Vec<Claim>,
}

/// Claim that a node holds at a position of the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Claim {
    /// Position in [`Evidence::states`].
    pub position: usize,
    /// Node that holds.
    pub node: NodeId,
}

/// Cost of a state where the node does not hold.
const NEVER: u32 = u32::MAX;

/// Finds evidence for a node in the one of some states that needs the fewest steps; `None` if the node holds in none of
/// them.
///
/// The number of steps is minimal if a finite path shows the node. A lasso has a shortest stem to a cycle, and a
/// shortest cycle from there. Of a conjunction of two temporal nodes the longer one is followed. Under fairness, a
/// finite path leads to a state from which there is a fair path.
#[must_use]
pub fn evidence(
    graph: &Graph,
    dag: &Dag,
    labels: &Labels,
    fairness: Option<&Fairness>,
    node: NodeId,
    states: &[u32],
) -> Option<Evidence> {
    let mut explainer =
        Explainer { graph, dag, labels, fairness, costs: BTreeMap::new(), evidence: Evidence::default() };
    let costs = explainer.cost(node);
    let start = states.iter().copied().filter(|&s| costs[s as usize] != NEVER).min_by_key(|&s| costs[s as usize])?;
    explainer.evidence.states.push(start);
    explainer.explain(node, start);
    Some(explainer.evidence)
}

struct Explainer<'a> {
    graph: &'a Graph,
    dag: &'a Dag,
    labels: &'a Labels,
    fairness: Option<&'a Fairness>,
    /// For each node needed, the number of steps of the evidence from each state.
    costs: BTreeMap<NodeId, Rc<Vec<u32>>>,
    evidence: Evidence,
}

impl Explainer<'_> {
    fn cost(&mut self, id: NodeId) -> Rc<Vec<u32>> {
        if let Some(known) = self.costs.get(&id) {
            return Rc::clone(known);
        }
        let pairs = |f: &[u32], g: &[u32], choose: fn(u32, u32) -> u32| {
            f.iter().zip(g).map(|(&f, &g)| choose(f, g)).collect::<Vec<u32>>()
        };
        let costs = match *self.dag.node(id) {
            Node::And(f, g) => pairs(&self.cost(f), &self.cost(g), u32::max),
            Node::Or(f, g) => pairs(&self.cost(f), &self.cost(g), u32::min),
            Node::Next(Quantifier::Some, f) => {
                let costs = self.cost(f);
                let cheapest = |row| self.graph.row(row).iter().map(|&t| self.unless_unfair(t, &costs)).min();
                let best = |row| cheapest(row).unwrap_or(NEVER);
                let best: Vec<u32> = (0..self.graph.rows() as u32).map(best).collect();
                let cost = |s| self.graph.row_of(s).map_or(NEVER, |row| best[row as usize].saturating_add(1));
                self.graph.ids().map(cost).collect()
            }
            Node::Until(Quantifier::Some, f, g) => self.distances(f, g),
            Node::WeakUntil(Quantifier::Some, f, g) => {
                // A lasso is infinite: its steps are not counted.
                let mut costs = self.distances(f, g);
                self.labels
                    .of(id)
                    .ones()
                    .filter(|&s| costs[s] == NEVER)
                    .collect::<Vec<_>>()
                    .iter()
                    .for_each(|&s| costs[s] = 0);
                costs
            }
            _ => {
                let set = self.labels.of(id);
                (0..self.graph.len()).map(|s| if set.contains(s) { 0 } else { NEVER }).collect()
            }
        };
        let costs = Rc::new(costs);
        self.costs.insert(id, Rc::clone(&costs));
        costs
    }

    /// Cost of a state as the target of a path: a fair path never reaches a state without fair paths.
    fn unless_unfair(&self, state: u32, costs: &[u32]) -> u32 {
        let counts = self.fairness.is_none_or(|fairness| fairness.surely().contains(state as usize));
        if counts { costs[state as usize] } else { NEVER }
    }

    /// Number of steps from each state through states with f to a state with g, plus the evidence for g.
    fn distances(&mut self, f: NodeId, g: NodeId) -> Vec<u32> {
        let hold = self.labels.of(f);
        let goal = self.cost(g);
        let mut distances: Vec<u32> = self.graph.ids().map(|state| self.unless_unfair(state, &goal)).collect();
        let mut buckets: Vec<Vec<u32>> = Vec::new();
        let put = |buckets: &mut Vec<Vec<u32>>, distance: u32, state| {
            let distance = distance as usize;
            if buckets.len() <= distance {
                buckets.resize(distance + 1, Vec::new());
            }
            buckets[distance].push(state);
        };
        for state in self.graph.ids().filter(|&s| distances[s as usize] != NEVER) {
            put(&mut buckets, distances[state as usize], state);
        }
        let mut reached = FixedBitSet::with_capacity(self.graph.rows());
        let mut distance = 0;
        while (distance as usize) < buckets.len() {
            for state in std::mem::take(&mut buckets[distance as usize]) {
                if distances[state as usize] != distance {
                    continue;
                }
                for &row in self.graph.rows_to(state) {
                    // States are processed nearest first, so a row is first reached from its nearest target.
                    if reached.put(row as usize) {
                        continue;
                    }
                    for &before in self.graph.members(row) {
                        if hold.contains(before as usize) && distances[before as usize] > distance + 1 {
                            distances[before as usize] = distance + 1;
                            put(&mut buckets, distance + 1, before);
                        }
                    }
                }
            }
            distance += 1;
        }
        distances
    }

    /// Whether a node is about one state only, so that explaining it takes no step.
    fn is_local(&self, id: NodeId) -> bool {
        match *self.dag.node(id) {
            Node::State { .. } => true,
            Node::And(f, g) | Node::Or(f, g) => self.is_local(f) && self.is_local(g),
            _ => false,
        }
    }

    fn claim(&mut self, node: NodeId) {
        let position = self.evidence.states.len() - 1;
        self.evidence.claims.push(Claim { position, node });
    }

    /// Extends the path to show a node that holds at its last state.
    fn explain(&mut self, id: NodeId, state: u32) {
        let s = state as usize;
        match *self.dag.node(id) {
            Node::And(f, g) => {
                // One run can show one temporal node; the other one is only claimed.
                let follow_g = !self.is_local(g) && (self.is_local(f) || self.cost(g)[s] > self.cost(f)[s]);
                let (followed, other) = if follow_g { (g, f) } else { (f, g) };
                if self.is_local(other) {
                    self.explain(other, state);
                } else {
                    self.claim(other);
                }
                self.explain(followed, state);
            }
            Node::Or(f, g) => {
                let better = if self.cost(g)[s] < self.cost(f)[s] { g } else { f };
                self.explain(better, state);
            }
            Node::Next(Quantifier::Some, f) => {
                let costs = self.cost(f);
                let successors = self.graph.successors(state).iter().copied();
                let next = successors.min_by_key(|&t| self.unless_unfair(t, &costs));
                if let Some(next) = next {
                    self.evidence.states.push(next);
                    self.explain(f, next);
                }
            }
            Node::Until(Quantifier::Some, f, g) => self.follow(f, g, state),
            Node::WeakUntil(Quantifier::Some, f, g) if self.distances(f, g)[s] != NEVER => self.follow(f, g, state),
            Node::WeakUntil(Quantifier::Some, f, _) => self.lasso(f, state),
            _ => self.claim(id),
        }
    }

    /// Extends the path through states with f to a state where g is shown.
    fn follow(&mut self, f: NodeId, g: NodeId, mut state: u32) {
        let distances = self.distances(f, g);
        let goal = self.cost(g);
        while distances[state as usize] != goal[state as usize] {
            self.claim(f);
            let nearer = distances[state as usize] - 1;
            let mut next = self.graph.successors(state).iter().copied();
            let Some(next) = next.find(|&t| distances[t as usize] == nearer) else { return };
            self.evidence.states.push(next);
            state = next;
        }
        self.explain(g, state);
    }

    /// Extends the path through states with f by a lasso, or to a state without steps.
    fn lasso(&mut self, f: NodeId, state: u32) {
        let constraints = self.fairness.map(Fairness::constraints);
        let Some(lasso) = lasso(self.graph, self.labels.of(f), constraints, state) else { return };
        self.claim(f);
        let knot = self.evidence.states.len() - 1;
        self.walk(f, &lasso.states);
        self.evidence.loop_start = lasso.loop_start.map(|start| knot + start);
    }

    /// Appends states to the path, claiming f in each.
    fn walk(&mut self, f: NodeId, states: &[u32]) {
        for &state in states {
            self.evidence.states.push(state);
            self.claim(f);
        }
    }
}
