//! Why a node holds in a state: a path or lasso as short as can be, as far as one path can say it.
//!
//! What holds on some path is shown by that path; what holds on all paths is only stated, at the state where it does.

use std::collections::BTreeMap;
use std::rc::Rc;

use fixedbitset::FixedBitSet;
use rustc_hash::FxHashMap;

use super::dag::{Dag, Node, NodeId};
use super::formula::Quantifier;
use super::label::{Labels, endings};
use crate::explore::{Graph, components};

/// A path through the graph, and what holds along it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Evidence {
    /// The states of the path.
    pub states: Vec<u32>,
    /// For a lasso, the position to which the last state steps back.
    pub loop_start: Option<usize>,
    /// What the path is to show, in the order of the path.
    pub claims: Vec<Claim>,
}

/// A node holds at a position of the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Claim {
    /// Position in [`Evidence::states`].
    pub position: usize,
    /// The node.
    pub node: NodeId,
}

/// Cost of a state where the node does not hold.
const NEVER: u32 = u32::MAX;

/// The evidence for a node at that one of the states which needs the fewest steps; `None` if it holds in none of them.
///
/// The number of steps is the smallest possible where a finite path shows the node. A lasso has a shortest stem to a cycle,
/// and a shortest cycle from there. Of a conjunction of two temporal parts the longer one is followed.
#[must_use]
pub fn evidence(
    graph: &Graph,
    dag: &Dag,
    labels: &Labels,
    fair: Option<&FixedBitSet>,
    node: NodeId,
    states: &[u32],
) -> Option<Evidence> {
    let mut explainer = Explainer { graph, dag, labels, fair, costs: BTreeMap::new(), evidence: Evidence::default() };
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
    fair: Option<&'a FixedBitSet>,
    /// For each node asked for, the steps that evidence takes from each state.
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
                let best = |row| self.graph.row(row).iter().map(|&t| costs[t as usize]).min().unwrap_or(NEVER);
                let best: Vec<u32> = (0..self.graph.rows() as u32).map(best).collect();
                let cost = |s| self.graph.row_of(s).map_or(NEVER, |row| best[row as usize].saturating_add(1));
                self.graph.ids().map(cost).collect()
            }
            Node::Until(Quantifier::Some, f, g) => self.distances(f, g),
            Node::WeakUntil(Quantifier::Some, f, g) => {
                // A lasso is for ever: it counts as nothing.
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

    /// Steps from each state through states with f to a state with g, and on with the evidence for g.
    fn distances(&mut self, f: NodeId, g: NodeId) -> Vec<u32> {
        let hold = self.labels.of(f);
        let mut distances = self.cost(g).to_vec();
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
                    // States come nearest first, so a row is reached first from its nearest.
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

    /// Whether a node speaks of one state only, so that explaining it takes no step.
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

    /// Shows a node, which holds at the last state of the path.
    fn explain(&mut self, id: NodeId, state: u32) {
        let s = state as usize;
        match *self.dag.node(id) {
            Node::And(f, g) => {
                // One run can show one temporal part; the other one is only claimed.
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
                let next = self.graph.successors(state).iter().copied().min_by_key(|&t| costs[t as usize]);
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

    /// Goes through states with f to the state where g is shown.
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

    /// Goes through states with f round a cycle, or to where paths end.
    fn lasso(&mut self, f: NodeId, state: u32) {
        let Some(lasso) = lasso(self.graph, self.labels.of(f), self.fair, state) else { return };
        self.claim(f);
        let knot = self.evidence.states.len() - 1;
        self.walk(f, &lasso.states);
        self.evidence.loop_start = lasso.loop_start.map(|start| knot + start);
    }

    /// Appends states to the path, all with f.
    fn walk(&mut self, f: NodeId, states: &[u32]) {
        for &state in states {
            self.evidence.states.push(state);
            self.claim(f);
        }
    }
}

/// A path without end, or one that ends where no step is left.
pub struct Lasso {
    /// Its states without the first one.
    pub states: Vec<u32>,
    /// How many steps lead to the state that the last one steps back to.
    pub loop_start: Option<usize>,
}

/// A path inside a set that goes round a cycle (through a fair state, if fairness is asked for), or to where paths end: a
/// shortest way there, and a shortest cycle from there.
fn lasso(graph: &Graph, within: &FixedBitSet, fair: Option<&FixedBitSet>, state: u32) -> Option<Lasso> {
    let endings = endings(graph, within, fair);
    let mut states = shortest(graph, state, within, false, |s| endings.contains(s as usize))?;
    let knot = states.last().copied().unwrap_or(state);
    let components = components(graph, within);
    if !components.on_cycle(knot) {
        return Some(Lasso { states, loop_start: None });
    }
    // The cycle: to a fair state first where one is asked for, then back to the knot.
    let loop_start = Some(states.len());
    let part = components.of[knot as usize];
    let mut inside = FixedBitSet::with_capacity(graph.len());
    within.ones().filter(|&s| components.of[s] == part).for_each(|s| inside.insert(s));
    let is_fair = |s: u32| fair.is_none_or(|fair| fair.contains(s as usize));
    let out = shortest(graph, knot, &inside, false, is_fair).unwrap_or_default();
    let turn = out.last().copied().unwrap_or(knot);
    let back = shortest(graph, turn, &inside, true, |s| s == knot).unwrap_or_default();
    states.extend_from_slice(&out);
    states.extend_from_slice(&back[..back.len().saturating_sub(1)]);
    Some(Lasso { states, loop_start })
}

/// States that [`near_lasso`] goes through.
const NEAR: usize = 10_000;

/// A lasso on all paths, in a set whose every state has a step to another one of the set, or none at all: one that comes
/// back to a state on the shortest way to its own end, if there is one among the nearest states, else any.
#[must_use]
pub fn near_lasso(graph: &Graph, within: &FixedBitSet, state: u32) -> Option<Lasso> {
    let mut parents: FxHashMap<u32, (u32, usize)> = FxHashMap::from_iter([(state, (state, 0))]);
    let mut queue = vec![state];
    let mut next = 0;
    let way = |parents: &FxHashMap<u32, (u32, usize)>, end: u32| {
        let before = |&at: &u32| Some(parents[&at].0).filter(|&parent| parent != at);
        let mut way: Vec<u32> = std::iter::successors(Some(end), before).collect();
        way.reverse();
        way
    };
    while let Some(&from) = queue.get(next) {
        next += 1;
        let depth = parents[&from].1;
        if graph.row_of(from).is_some() && graph.successors(from).is_empty() {
            return Some(Lasso { states: way(&parents, from)[1..].to_vec(), loop_start: None });
        }
        for &target in graph.successors(from).iter().filter(|&&target| within.contains(target as usize)) {
            if let Some(&(_, above)) = parents.get(&target) {
                let states = if above <= depth { way(&parents, from) } else { Vec::new() };
                if states.get(above) == Some(&target) {
                    return Some(Lasso { states: states[1..].to_vec(), loop_start: Some(above) });
                }
            } else if parents.len() < NEAR {
                parents.insert(target, (from, depth + 1));
                queue.push(target);
            }
        }
    }
    wandering(graph, within, state)
}

/// The path that always goes on to the state with the least number, which is seldom far from the initial one.
fn wandering(graph: &Graph, within: &FixedBitSet, state: u32) -> Option<Lasso> {
    let mut positions: FxHashMap<u32, usize> = FxHashMap::from_iter([(state, 0)]);
    let mut states = vec![state];
    loop {
        let successors = graph.successors(states[states.len() - 1]);
        if successors.is_empty() {
            return Some(Lasso { states: states[1..].to_vec(), loop_start: None });
        }
        let next = successors.iter().copied().filter(|&next| within.contains(next as usize)).min()?;
        if let Some(&start) = positions.get(&next) {
            return Some(Lasso { states: states[1..].to_vec(), loop_start: Some(start) });
        }
        positions.insert(next, states.len());
        states.push(next);
    }
}

/// A shortest path inside a set to a state that satisfies `goal`, without its first state. With `leave`, the first state does
/// not count as there already.
#[must_use]
pub fn shortest(
    graph: &Graph,
    from: u32,
    within: &FixedBitSet,
    leave: bool,
    goal: impl Fn(u32) -> bool,
) -> Option<Vec<u32>> {
    if !leave && goal(from) {
        return Some(Vec::new());
    }
    let mut parents: FxHashMap<u32, u32> = FxHashMap::default();
    let mut gone = FixedBitSet::with_capacity(graph.rows());
    let mut queue = vec![from];
    let mut next = 0;
    while let Some(&state) = queue.get(next) {
        next += 1;
        if graph.row_of(state).is_none_or(|row| gone.put(row as usize)) {
            continue;
        }
        for &target in graph.successors(state) {
            if !within.contains(target as usize) || parents.contains_key(&target) {
                continue;
            }
            parents.insert(target, state);
            if goal(target) {
                let mut path = vec![target];
                while parents[&path[path.len() - 1]] != from {
                    path.push(parents[&path[path.len() - 1]]);
                }
                path.reverse();
                return Some(path);
            }
            queue.push(target);
        }
    }
    None
}
