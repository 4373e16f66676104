//! Breadth-first search: batches of states are expanded on all processors, and their successors inserted sequentially,
//! so that the numbering does not depend on the number of threads. While one batch is inserted, the next is expanded.

use std::hint::black_box;
use std::ops::Range;

use rayon::prelude::*;

use crate::budget::{Budget, Progress, Stop, is_available};
use crate::graph::Graph;
use crate::space::{StateSpace, Step, Successors};
use crate::store::{Store, growth, hash};
use crate::table::Table;

/// Maximum number of successors computed before they are inserted, unless one state alone has more.
const BATCH: u64 = 1 << 15;

/// Minimum number of successors in a batch, so that the search does not slow down when the budget is almost used up.
const LEAST: u64 = 1 << 10;

/// Number of states below which a batch is expanded on one thread.
const ALONE: usize = 64;

/// Bytes that are always there.
const SMALL: u64 = 1 << 22;

/// Number of states whose rows are looked up together.
const TOGETHER: usize = 64;

/// Explores a space until all states are found, the budget is used up, or `watch` returns a reason to stop. `watch` is
/// called before each batch, and once at the end.
pub fn explore(space: &dyn StateSpace, budget: Budget, watch: &mut dyn FnMut(&Progress) -> Option<String>) -> Graph {
    // Numbers of states and rows have 32 bits; half of the range leaves room for a batch.
    let budget = Budget { states: budget.states.min(u64::from(u32::MAX) >> 1), ..budget };
    let (graph, states) = (Graph::empty(space.words()), Store::new(space.words()));
    let mut search = Search { space, budget, graph, states, rows: Table::default(), firsts: Vec::new() };
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
    /// Table of rows by the relevant bits of their first states, if states can share rows.
    rows: Table,
    firsts: Vec<u32>,
}

/// States whose rows are new and have to be computed.
#[derive(Default)]
struct Batch {
    ids: Vec<u32>,
    words: Vec<u64>,
}

impl Search<'_> {
    fn run(&mut self, watch: &mut dyn FnMut(&Progress) -> Option<String>) -> Stop {
        if self.space.refusal().is_none() {
            if self.space.fan_out(None) > self.budget.states {
                return Stop::States(self.budget.states);
            }
            self.enter_initial();
        }
        let mut level = 0..self.states.len() as u32;
        while !level.is_empty() {
            self.graph.levels.push(level.start);
            if let Some(stop) = self.level(level.end, watch) {
                return stop;
            }
            level = level.end..self.states.len() as u32;
        }
        self.space.refusal().map_or(Stop::Complete, Stop::Refused)
    }

    fn enter_initial(&mut self) {
        let mut roots = Successors::default();
        self.space.initial(&mut |step: Step<'_>| roots.add(step));
        self.graph.failures.extend(roots.failures.iter().map(|&(_, failure)| (None, failure)));
        self.states.enter(&roots.words, &mut Vec::new());
        self.graph.initial = (0..self.states.len() as u32).collect();
    }

    /// Expands the states before `end`.
    fn level(&mut self, end: u32, watch: &mut dyn FnMut(&Progress) -> Option<String>) -> Option<Stop> {
        let (mut batch, mut found): (Batch, Vec<Successors>) = Default::default();
        while self.graph.expanded() < end as usize {
            let waiting: usize = found.iter().map(|found| found.words.len() / self.space.words()).sum();
            let mut stop = self.exhausted(waiting + BATCH as usize);
            if stop.is_none() {
                stop = watch(&self.progress()).map(Stop::Watcher);
            }
            let rest = self.graph.expanded() as u32..end;
            let next = if stop.is_none() { self.batch(rest, waiting as u64) } else { None };
            let Some(next) = next else {
                self.enter(&batch.ids, &found);
                return stop.or(Some(Stop::States(self.budget.states)));
            };
            let space = self.space;
            (found, batch) = if next.ids.len() < ALONE {
                // Waking other threads costs more than expanding a few states.
                self.enter(&batch.ids, &found);
                (expanded(space, &next.words), next)
            } else {
                (rayon::join(|| expanded(space, &next.words), || self.enter(&batch.ids, &found)).0, next)
            };
        }
        self.enter(&batch.ids, &found);
        None
    }

    /// Assigns rows to the next states of `rest`, and returns those whose rows are new: at most as many as have
    /// [`BATCH`] successors in total, but at least one. `None` if that one has more successors than the budget allows.
    /// `waiting` successors have not been inserted yet.
    fn batch(&mut self, rest: Range<u32>, waiting: u64) -> Option<Batch> {
        let Self { space, budget, graph, states, rows, firsts } = self;
        let most = budget.states.saturating_sub(states.len() as u64 + waiting).clamp(LEAST, BATCH);
        let mut total = 0;
        let mut batch = Batch::default();
        let mask = space.relevant();
        let kernel = |id: u32| states.get(id).iter().zip(mask.into_iter().flatten()).map(|(word, mask)| word & mask);
        for first in rest.clone().step_by(TOGETHER) {
            let ids = first..rest.end.min(first + TOGETHER as u32);
            let mut hashes = [0; TOGETHER];
            if mask.is_some() {
                rows.reserve(TOGETHER, |row| hash(kernel(firsts[row as usize])));
                let mut touched = 0;
                for (hashed, id) in hashes.iter_mut().zip(ids.clone()) {
                    *hashed = hash(kernel(id));
                    touched ^= rows.touch(*hashed);
                }
                for hashed in &hashes[..ids.len()] {
                    let row = rows.candidate(*hashed);
                    touched ^= row.map_or(0, |row| states.get(firsts[row as usize])[0] as u32);
                }
                black_box(touched);
            }
            for (id, hashed) in ids.zip(hashes) {
                let same = |row: u32| kernel(firsts[row as usize]).eq(kernel(id));
                let mut row = if mask.is_some() { rows.find(hashed, same) } else { None };
                if row.is_none() {
                    let fan_out = space.fan_out(Some(states.get(id)));
                    total = fan_out.saturating_add(total);
                    if fan_out > budget.states || (!batch.ids.is_empty() && total > most) {
                        return (!batch.ids.is_empty()).then_some(batch);
                    }
                    row = mask.map(|_| rows.enter(hashed, firsts.len() as u32, |_| false));
                    firsts.extend(row.map(|_| id));
                    batch.ids.push(id);
                    batch.words.extend_from_slice(states.get(id));
                }
                graph.row_of.push(row.unwrap_or(id));
            }
        }
        Some(batch)
    }

    /// Inserts the successors of some states.
    fn enter(&mut self, ids: &[u32], found: &[Successors]) {
        let Self { graph, states, space, .. } = self;
        let words = space.words();
        let mut ids = ids.iter();
        for found in found {
            let start = graph.targets.len() as u64;
            states.enter(&found.words, &mut graph.targets);
            graph.starts.extend(found.ends.iter().map(|&end| start + (end / words) as u64));
            let own = &ids.as_slice()[..found.ends.len()];
            graph.failures.extend(found.failures.iter().map(|&(state, failure)| (Some(own[state]), failure)));
            ids = ids.as_slice()[own.len()..].iter();
        }
    }

    fn bytes(&self) -> u64 {
        self.graph.bytes() + self.states.bytes() + self.rows.bytes() + self.firsts.capacity() as u64 * 4
    }

    /// Reason why the next batch of successors is not to be inserted.
    fn exhausted(&self, successors: usize) -> Option<Stop> {
        let states = self.budget.states;
        let rows = self.rows.growth(successors + TOGETHER);
        let (table, list) = self.states.growth(successors);
        let lists = list + self.graph.growth(self.states.len(), successors) + growth(&self.firsts, successors);
        let most = self.budget.bytes.max(SMALL);
        // A table and the larger one that is made of it are there together; a list becomes a longer one in its place.
        if self.bytes() > self.budget.bytes || rows.max(table) > 0 && self.bytes() + rows.max(table) > most {
            Some(Stop::Bytes(self.budget.bytes))
        } else if rows + table + lists > SMALL && !is_available(rows + table + lists) {
            Some(Stop::Watcher(format!(
                "the system has no more memory than the {} MiB of the states",
                self.bytes() >> 20
            )))
        } else if self.states.len() as u64 > states {
            Some(Stop::States(states))
        } else {
            self.space.refusal().map(Stop::Refused)
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

/// Computes the steps out of some states, on all processors if that is worthwhile.
fn expanded(space: &dyn StateSpace, states: &[u64]) -> Vec<Successors> {
    let piece = |states: &[u64]| {
        let mut successors = Successors::default();
        space.expand(states, &mut successors);
        successors
    };
    let (words, count) = (space.words(), states.len() / space.words());
    if count < ALONE {
        vec![piece(states)]
    } else {
        states.par_chunks(words * (count / 8).max(16)).map(piece).collect()
    }
}
