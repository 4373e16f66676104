//! Breadth-first search: batches of states are expanded on all processors, and their successors entered one after another,
//! so that the numbering does not depend on the number of threads.

use std::ops::Range;
use std::sync::OnceLock;

use rayon::prelude::*;

use super::budget::{Budget, Progress, Stop};
use super::graph::Graph;
use super::space::{Failure, StateSpace, Step};
use super::store::Store;

/// Successors computed before they are entered, at most, unless one state alone has more.
const BATCH: u64 = 1 << 18;

/// Explores a space until everything is found, the budget is used up, or `watch` gives a reason to stop. `watch` is called
/// after each batch.
pub fn explore(space: &dyn StateSpace, budget: Budget, watch: &mut dyn FnMut(&Progress) -> Option<String>) -> Graph {
    let mut graph = Graph {
        store: Store::new(space.words()),
        initial: Vec::new(),
        rows: vec![0],
        targets: Vec::new(),
        parents: Vec::new(),
        levels: Vec::new(),
        failures: Vec::new(),
        stop: Stop::Complete,
        backward: OnceLock::new(),
    };
    if space.fan_out(None) > most(budget) {
        graph.stop = Stop::States(most(budget));
        return graph;
    }
    let mut roots = Expansion::default();
    space.initial(&mut |step| roots.add(step));
    graph.failures.extend(roots.failures.iter().map(|&failure| (None, failure)));
    for state in roots.states(space.words()) {
        let (id, new) = graph.store.insert(state);
        if new {
            graph.parents.push(id);
            graph.initial.push(id);
        }
    }
    let mut level = 0..graph.len() as u32;
    while !level.is_empty() {
        graph.levels.push(level.start);
        let mut rest = level.clone();
        while !rest.is_empty() {
            let batch = batch(&graph, space, rest.clone(), budget);
            let Some(batch) = batch.filter(|_| within(&graph, budget)) else {
                graph.stop = exhausted(&graph, budget);
                return graph;
            };
            if let Some(reason) = watch(&progress(&graph)) {
                graph.stop = Stop::Watcher(reason);
                return graph;
            }
            rest.start = batch.end;
            let store = &graph.store;
            let expanded: Vec<Expansion> =
                batch.clone().into_par_iter().map(|id| expand(space, store.get(id))).collect();
            for (id, expansion) in batch.zip(&expanded) {
                enter(&mut graph, id, expansion, space.words());
            }
        }
        level = level.end..graph.len() as u32;
    }
    graph
}

/// The next states to expand: as many of `rest` as have [`BATCH`] successors together, but one at least. `None` if that one
/// has more than the budget allows.
fn batch(graph: &Graph, space: &dyn StateSpace, rest: Range<u32>, budget: Budget) -> Option<Range<u32>> {
    let mut total = 0;
    let mut end = rest.start;
    for id in rest.clone() {
        let fan_out = space.fan_out(Some(graph.state(id)));
        total = fan_out.saturating_add(total);
        if fan_out > most(budget) || (end > rest.start && total > BATCH) {
            break;
        }
        end += 1;
    }
    (end > rest.start).then_some(rest.start..end)
}

fn within(graph: &Graph, budget: Budget) -> bool {
    graph.len() as u64 <= most(budget) && graph.bytes() <= budget.bytes
}

/// How many states there may be: what the budget allows, and no more than can be numbered.
fn most(budget: Budget) -> u64 {
    budget.states.min(u64::from(u32::MAX) >> 1)
}

fn exhausted(graph: &Graph, budget: Budget) -> Stop {
    if graph.bytes() > budget.bytes { Stop::Bytes(budget.bytes) } else { Stop::States(most(budget)) }
}

fn progress(graph: &Graph) -> Progress {
    Progress {
        states: graph.len() as u64,
        expanded: graph.expanded() as u64,
        steps: graph.steps() as u64,
        depth: graph.depth(),
        bytes: graph.bytes(),
    }
}

/// The steps of one state.
#[derive(Default)]
struct Expansion {
    words: Vec<u64>,
    failures: Vec<Failure>,
}

impl Expansion {
    fn add(&mut self, step: Step<'_>) {
        match step {
            Step::To(state) => self.words.extend_from_slice(state),
            Step::Fails(failure) => self.failures.push(failure),
        }
    }

    fn states(&self, words: usize) -> impl Iterator<Item = &[u64]> {
        self.words.chunks_exact(words)
    }
}

fn expand(space: &dyn StateSpace, state: &[u64]) -> Expansion {
    let mut expansion = Expansion::default();
    space.successors(state, &mut |step| expansion.add(step));
    expansion
}

fn enter(graph: &mut Graph, id: u32, expansion: &Expansion, words: usize) {
    for state in expansion.states(words) {
        let (target, new) = graph.store.insert(state);
        if new {
            graph.parents.push(id);
        }
        graph.targets.push(target);
    }
    graph.rows.push(graph.targets.len() as u64);
    graph.failures.extend(expansion.failures.first().map(|&failure| (Some(id), failure)));
}
