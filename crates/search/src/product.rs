//! The product of a graph with an observer: a deterministic automaton that remembers what a formula needs of the past.
//!
//! The memory of a state follows from a message of the previous state, so states with the same row and the same message
//! share a row of the product too.

use crate::budget::{Budget, Progress, Stop};
use crate::graph::Graph;
use crate::store::Store;

/// Deterministic automaton that is run along paths; its memory has a fixed length.
pub trait Observer: Sync {
    /// Length of a memory and of a message, in words.
    fn len(&self) -> usize;
    /// Whether the observer remembers nothing.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Message of power-on to the first state.
    fn beginning(&self) -> Vec<u64>;
    /// Computes the message of a state with its memory to the next state.
    fn message(&self, state: &[u64], memory: &[u64], message: &mut Vec<u64>);
    /// Computes the memory of a state that receives a message.
    fn remember(&self, message: &[u64], state: &[u64], memory: &mut Vec<u64>);
}

/// Computes the product. The words of its states are the number of a state of the graph and its memory.
#[must_use]
pub fn observed(
    graph: &Graph,
    observer: &dyn Observer,
    budget: Budget,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> Graph {
    let words = 1 + observer.len();
    let (states, rows, result) = (Store::new(words), Store::new(words), Graph::empty(words));
    let mut product = Product { graph, observer, states, rows, result };
    product.result.stop = match product.run(budget, watch) {
        Stop::Complete => graph.stop().clone(),
        stop => stop,
    };
    let Product { states, mut result, .. } = product;
    result.len = states.len();
    result.arena = states.into_arena();
    result
}

struct Product<'a> {
    graph: &'a Graph,
    observer: &'a dyn Observer,
    states: Store,
    /// Row of the graph and message, for each row of the product.
    rows: Store,
    result: Graph,
}

/// Number of states expanded between two checks of the limits.
const TURN: usize = 1 << 12;

/// Row of a state that the graph does not expand.
const NO_ROW: u32 = u32::MAX;

impl Product<'_> {
    fn run(&mut self, budget: Budget, watch: &mut dyn FnMut(&Progress) -> Option<String>) -> Stop {
        let beginning = self.observer.beginning();
        let initial = self.enter(&beginning, self.graph.initial());
        // The product has a state for each memory of a state, and after the first scan there is only one.
        self.result.initial = initial;
        self.result.levels.extend((!self.result.initial.is_empty()).then_some(0));
        // Sources of later failing steps are cut.
        let of_power_on = self.graph.failures().iter().filter(|(state, _)| state.is_none());
        self.result.failures.extend(of_power_on);
        let open = self.graph.open();
        let (mut next, mut level_end) = (0, self.states.len());
        let mut message = Vec::new();
        while next < self.states.len() {
            if next == level_end {
                self.result.levels.push(next as u32);
                level_end = self.states.len();
            }
            if next % TURN == 0 {
                let progress = self.progress(next);
                let stop = if progress.bytes > budget.bytes {
                    Some(Stop::Bytes(budget.bytes))
                } else if progress.states > budget.states {
                    Some(Stop::States(budget.states))
                } else {
                    watch(&progress).map(Stop::Watcher)
                };
                if let Some(stop) = stop {
                    return stop;
                }
            }
            let words = self.states.get(next as u32);
            let base = words[0] as u32;
            self.observer.message(self.graph.state(base), &words[1..], &mut message);
            if open.contains(base as usize) {
                self.result.cut.push(next as u32);
            }
            let row = self.row(self.graph.row_of(base).unwrap_or(NO_ROW), &message, base);
            self.result.row_of.push(row);
            next += 1;
        }
        Stop::Complete
    }

    fn progress(&self, expanded: usize) -> Progress {
        Progress {
            states: self.states.len() as u64,
            expanded: expanded as u64,
            depth: self.result.levels.len().saturating_sub(1),
            bytes: self.states.bytes() + self.rows.bytes() + self.result.bytes(),
        }
    }

    /// Row of the product for a row of the graph, which is that of `state`, and a message.
    fn row(&mut self, row: u32, message: &[u64], state: u32) -> u32 {
        let mut key = vec![u64::from(row)];
        key.extend_from_slice(message);
        let (known, mut number) = (self.rows.len(), Vec::new());
        self.rows.enter(&key, &mut number);
        if self.rows.len() > known {
            let graph = self.graph;
            let targets = self.enter(message, graph.successors(state));
            self.result.targets.extend(targets);
            self.result.starts.push(self.result.targets.len() as u64);
        }
        number[0]
    }

    /// Numbers of states of the graph that receive a message.
    fn enter(&mut self, message: &[u64], states: &[u32]) -> Vec<u32> {
        let (mut words, mut memory, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
        for &state in states {
            self.observer.remember(message, self.graph.state(state), &mut memory);
            words.push(u64::from(state));
            words.extend_from_slice(&memory);
        }
        self.states.enter(&words, &mut numbers);
        numbers
    }
}
