//! Breadth-first search: batches of states are expanded on all processors, and their successors entered one after another,
//! so that the numbering does not depend on the number of threads.

use std::ops::Range;

use rayon::prelude::*;

use super::budget::{Budget, Progress, Stop};
use super::graph::Graph;
use super::space::{Failure, StateSpace, Step};
use super::store::Store;

/// Successors computed before they are entered, at most, unless one state alone has more.
const BATCH: u64 = 1 << 18;

/// Batches of fewer states are expanded on one thread.
const ALONE: usize = 64;

/// Explores a space until everything is found, the budget is used up, or `watch` gives a reason to stop. `watch` is called
/// before each batch, and once at the end.
pub fn explore(space: &dyn StateSpace, budget: Budget, watch: &mut dyn FnMut(&Progress) -> Option<String>) -> Graph {
    // Numbers of states and rows have 32 bits; half of that leaves room for a batch.
    let budget = Budget { states: budget.states.min(u64::from(u32::MAX) >> 1), ..budget };
    let mut search = Search { space, budget, graph: Graph::empty(space.words()), states: Store::new(space.words()), kernels: None };
    search.kernels = space.relevant().map(|_| Store::new(space.words()));
    search.graph.stop = search.run(watch);
    watch(&search.progress());
    let Search { mut graph, states, .. } = search;
    graph.len = states.len();
    graph.arena = states.into_arena();
    graph
}

struct Search<'a> {
    space: &'a dyn StateSpace,
    budget: Budget,
    graph: Graph,
    states: Store,
    /// The relevant parts of the states expanded so far, if states can share rows: a kernel's number is that of its row.
    kernels: Option<Store>,
}

impl Search<'_> {
    fn run(&mut self, watch: &mut dyn FnMut(&Progress) -> Option<String>) -> Stop {
        if let Some(reason) = self.space.refusal() {
            return Stop::Refused(reason);
        }
        if self.space.fan_out(None) > self.budget.states {
            return Stop::States(self.budget.states);
        }
        self.enter_initial();
        let mut level = 0..self.states.len() as u32;
        while !level.is_empty() {
            self.graph.levels.push(level.start);
            while self.graph.expanded() < level.end as usize {
                if let Some(stop) = self.exhausted() {
                    return stop;
                }
                if let Some(reason) = watch(&self.progress()) {
                    return Stop::Watcher(reason);
                }
                let rest = self.graph.expanded() as u32..level.end;
                let Some(batch) = self.batch(rest) else { return Stop::States(self.budget.states) };
                let (space, store) = (self.space, &self.states);
                let expand = |&id: &u32| Expansion::of(|add| space.successors(store.get(id), add));
                // Waking other threads costs more than a few states.
                let expansions: Vec<Expansion> = if batch.len() < ALONE {
                    batch.iter().map(expand).collect()
                } else {
                    batch.par_iter().map(expand).collect()
                };
                for (id, expansion) in batch.iter().zip(&expansions) {
                    self.enter(*id, expansion);
                }
            }
            level = level.end..self.states.len() as u32;
        }
        Stop::Complete
    }

    fn enter_initial(&mut self) {
        let space = self.space;
        let roots = Expansion::of(|add| space.initial(add));
        self.graph.failures.extend(roots.failures.iter().map(|&failure| (None, failure)));
        for state in roots.words.chunks_exact(space.words()) {
            let (id, new) = self.states.insert(state);
            if new {
                self.graph.initial.push(id);
            }
        }
    }

    /// Gives the next states of `rest` their rows, and returns those of them whose rows are new and have to be filled: as
    /// many as have [`BATCH`] successors together, but one at least. `None` if that one has more than the budget allows.
    fn batch(&mut self, rest: Range<u32>) -> Option<Vec<u32>> {
        let mut total = 0;
        let mut batch = Vec::new();
        let mut kernel = Vec::new();
        for id in rest {
            let state = self.states.get(id);
            let mask = self.space.relevant();
            kernel.clear();
            kernel.extend(state.iter().zip(mask.into_iter().flatten()).map(|(word, mask)| word & mask));
            let mut row = self.kernels.as_ref().and_then(|kernels| kernels.find(&kernel));
            if row.is_none() {
                let fan_out = self.space.fan_out(Some(state));
                total = fan_out.saturating_add(total);
                if fan_out > self.budget.states || (!batch.is_empty() && total > BATCH) {
                    return (!batch.is_empty()).then_some(batch);
                }
                row = self.kernels.as_mut().map(|kernels| kernels.insert(&kernel).0);
                batch.push(id);
            }
            self.graph.row_of.push(row.unwrap_or(id));
        }
        Some(batch)
    }

    fn enter(&mut self, id: u32, expansion: &Expansion) {
        let Self { graph, states, .. } = self;
        for state in expansion.words.chunks_exact(self.space.words()) {
            let (target, _) = states.insert(state);
            graph.targets.push(target);
        }
        graph.starts.push(graph.targets.len() as u64);
        graph.failures.extend(expansion.failures.iter().map(|&failure| (Some(id), failure)));
    }

    fn bytes(&self) -> u64 {
        self.graph.bytes() + self.states.bytes() + self.kernels.as_ref().map_or(0, Store::bytes)
    }

    fn exhausted(&self) -> Option<Stop> {
        let states = self.budget.states;
        if self.bytes() > self.budget.bytes {
            Some(Stop::Bytes(self.budget.bytes))
        } else {
            (self.states.len() as u64 > states).then_some(Stop::States(states))
        }
    }

    fn progress(&self) -> Progress {
        Progress {
            states: self.states.len() as u64,
            expanded: self.graph.expanded() as u64,
            depth: self.graph.depth(),
            bytes: self.bytes(),
        }
    }
}

/// The steps of one state, and the ways in which steps of it fail.
#[derive(Default)]
struct Expansion {
    words: Vec<u64>,
    failures: Vec<Failure>,
}

impl Expansion {
    fn of(visit: impl FnOnce(&mut dyn FnMut(Step<'_>))) -> Self {
        let mut expansion = Self::default();
        visit(&mut |step| match step {
            Step::To(state) => expansion.words.extend_from_slice(state),
            Step::Fails(failure) if expansion.failures.contains(&failure) => {}
            Step::Fails(failure) => expansion.failures.push(failure),
        });
        expansion
    }
}
