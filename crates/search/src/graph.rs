//! The reachability graph: states, steps in compressed sparse rows, and what is missing of both.
//!
//! States with the same successors share a row: at the end of a scan, all states that differ in inputs only.

use std::sync::OnceLock;

use fixedbitset::FixedBitSet;

use crate::budget::Stop;
use crate::space::DeadEnd;
use crate::store::growth;
use petril_base::Rows;

/// Reachability graph of states numbered in breadth-first order: numbers never decrease with the distance.
pub struct Graph {
    /// Words of the states, one state after another; empty if they are kept elsewhere.
    pub(crate) arena: Vec<u64>,
    pub(crate) words: usize,
    pub(crate) len: usize,
    /// Initial states.
    pub(crate) initial: Vec<u32>,
    /// Row of each expanded state; these come first.
    pub(crate) row_of: Vec<u32>,
    /// Offsets of the rows: `targets[starts[r]..starts[r + 1]]` is row r.
    pub(crate) starts: Vec<u64>,
    pub(crate) targets: Vec<u32>,
    /// First state of each breadth-first level.
    pub(crate) levels: Vec<u32>,
    /// States with a step that leads nowhere: of each row its first state, once for each failure; `None` stands for the
    /// initial step.
    pub(crate) failures: Vec<(Option<u32>, DeadEnd)>,
    /// States of which not all steps are known, in addition to those not expanded and those with a failing step.
    pub(crate) cut: Vec<u32>,
    pub(crate) stop: Stop,
    pub(crate) members: OnceLock<Rows<u32>>,
    pub(crate) backward: OnceLock<Rows<u32>>,
    /// Parent of each state: the state from which it was first reached; its own number for an initial state.
    pub(crate) parents: OnceLock<Vec<u32>>,
}

/// A graph in breadth-first order with one initial state, state 0, in which no two states share a row.
pub struct Parts {
    /// Length of a state in words.
    pub words: usize,
    /// Number of states.
    pub states: usize,
    /// The states' words, one state after another.
    pub arena: Vec<u64>,
    /// `targets[starts[s]..starts[s + 1]]` are the successors of state s; only the first states have any, as many as are expanded.
    pub starts: Vec<u64>,
    /// Successors, as numbers of states.
    pub targets: Vec<u32>,
    /// First state of each breadth-first level.
    pub levels: Vec<u32>,
    /// Why the search ended.
    pub stop: Stop,
}

impl Graph {
    /// Makes the graph of `states` states that are kept elsewhere: state 0 is the initial one, the first states are
    /// expanded, and `targets[starts[s]..starts[s + 1]]` are the successors of an expanded state s.
    ///
    /// Unless the graph is complete, according to `stop`, a last state is added that stands for all unknown ones, with
    /// the number that targets give it.
    #[must_use]
    pub fn of_rows(states: usize, starts: Vec<u64>, targets: Vec<u32>, stop: Stop) -> Self {
        let rows = starts.len().saturating_sub(1) as u32;
        let len = states + usize::from(stop != Stop::Complete || (rows as usize) < states);
        let (initial, row_of) = ((0..states.min(1) as u32).collect(), (0..rows).collect());
        Self { len, initial, row_of, starts, targets, stop, ..Self::empty(0) }
    }

    /// The graph that an engine of its own found.
    #[must_use]
    pub fn of_parts(parts: Parts) -> Self {
        let Parts { words, states: len, arena, starts, targets, levels, stop } = parts;
        let rows = starts.len().saturating_sub(1) as u32;
        let (initial, row_of) = ((0..len.min(1) as u32).collect(), (0..rows).collect());
        Self { arena, len, initial, row_of, starts, targets, levels, stop, ..Self::empty(words) }
    }

    /// Adds steps that lead nowhere, each with a state it leaves, nearest first, once for each state and dead end.
    pub fn add_failures(&mut self, failures: impl IntoIterator<Item = (u32, DeadEnd)>) {
        self.failures.extend(failures.into_iter().map(|(state, dead_end)| (Some(state), dead_end)));
    }

    /// Makes the graph of states that are kept elsewhere and may share rows: see [`followed`](super::followed).
    pub(crate) fn of_pairs(initial: Vec<u32>, row_of: Vec<u32>, starts: Vec<u64>, targets: Vec<u32>) -> Self {
        Self { len: row_of.len(), initial, row_of, starts, targets, ..Self::empty(0) }
    }

    /// Makes an empty graph of states of `words` words.
    pub(crate) fn empty(words: usize) -> Self {
        Self {
            arena: Vec::new(),
            words,
            len: 0,
            initial: Vec::new(),
            row_of: Vec::new(),
            starts: vec![0],
            targets: Vec::new(),
            levels: Vec::new(),
            failures: Vec::new(),
            cut: Vec::new(),
            stop: Stop::Complete,
            members: OnceLock::new(),
            backward: OnceLock::new(),
            parents: OnceLock::new(),
        }
    }

    /// Number of states.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no state.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of known steps, counted for each state.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.row_of.iter().map(|&row| self.row(row).len() as u64).sum()
    }

    /// Words of a state.
    #[must_use]
    pub fn state(&self, id: u32) -> &[u64] {
        let start = id as usize * self.words;
        &self.arena[start..start + self.words]
    }

    /// The initial states.
    #[must_use]
    pub fn initial(&self) -> &[u32] {
        &self.initial
    }

    /// Numbers of all states.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = u32> + Clone + use<> {
        0..self.len() as u32
    }

    /// Known successors of a state, one for each step.
    #[must_use]
    pub fn successors(&self, id: u32) -> &[u32] {
        self.row_of.get(id as usize).map_or(&[], |&row| self.row(row))
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Row of a state, if the state was expanded.
    #[must_use]
    pub fn row_of(&self, id: u32) -> Option<u32> {
        self.row_of.get(id as usize).copied()
    }

    /// Targets of a row: the successors of all states that share it.
    #[must_use]
    pub fn row(&self, row: u32) -> &[u32] {
        &self.targets[self.starts[row as usize] as usize..self.starts[row as usize + 1] as usize]
    }

    /// States that share a row, ascending. The lists are built on first use.
    #[must_use]
    pub fn members(&self, row: u32) -> &[u32] {
        let pairs = || self.row_of.iter().zip(0..).map(|(&row, state)| (row as usize, state));
        &self.members.get_or_init(|| Rows::group(self.rows(), pairs()))[row as usize]
    }

    /// Rows that contain a state, once for each step. The lists are built on first use.
    #[must_use]
    pub fn rows_to(&self, id: u32) -> &[u32] {
        let rows = 0..self.rows() as u32;
        let pairs = || rows.clone().flat_map(|row| self.row(row).iter().map(move |&target| (target as usize, row)));
        &self.backward.get_or_init(|| Rows::group(self.len(), pairs()))[id as usize]
    }

    /// Open states, of which not all successors are known: not expanded, cut, or with a failing step.
    #[must_use]
    pub fn open(&self) -> FixedBitSet {
        let mut open = FixedBitSet::with_capacity(self.len());
        open.insert_range(self.expanded()..self.len());
        let failing = self.failures.iter().filter_map(|(state, _)| self.row_of((*state)?));
        failing.flat_map(|row| self.members(row)).for_each(|&state| open.insert(state as usize));
        self.cut.iter().for_each(|&state| open.insert(state as usize));
        open
    }

    /// Number of expanded states; these come first.
    #[must_use]
    pub fn expanded(&self) -> usize {
        self.row_of.len()
    }

    /// Whether all initial states are known.
    #[must_use]
    pub fn knows_initial(&self) -> bool {
        !self.initial.is_empty() && self.failures.iter().all(|(state, _)| state.is_some())
    }

    /// Failing steps, each with its source state, nearest first; `None` stands for the step to an initial state.
    #[must_use]
    pub fn failures(&self) -> &[(Option<u32>, DeadEnd)] {
        &self.failures
    }

    /// Reason why the search ended.
    #[must_use]
    pub fn stop(&self) -> &Stop {
        &self.stop
    }

    /// Whether every reachable state and step is in the graph.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.stop == Stop::Complete && self.failures.is_empty() && self.cut.is_empty()
    }

    /// Maximum distance of a state from an initial state, in steps.
    #[must_use]
    pub fn depth(&self) -> usize {
        self.levels.len().saturating_sub(1)
    }

    /// A shortest path from an initial state to a state, both included.
    #[must_use]
    pub fn path_to(&self, id: u32) -> Vec<u32> {
        let parents = self.parents.get_or_init(|| self.first_reached_from());
        let mut path = vec![id];
        let mut at = id;
        while parents[at as usize] != at {
            at = parents[at as usize];
            path.push(at);
        }
        path.reverse();
        path
    }

    /// Parent of each state: the first state with a step to it. Rows are ordered by distance, so it is one of the
    /// nearest.
    fn first_reached_from(&self) -> Vec<u32> {
        let mut first_of_row = vec![u32::MAX; self.rows()];
        for (state, &row) in self.row_of.iter().enumerate().rev() {
            first_of_row[row as usize] = state as u32;
        }
        let mut parents = vec![u32::MAX; self.len];
        self.initial.iter().for_each(|&state| parents[state as usize] = state);
        for (row, &state) in (0..).zip(&first_of_row) {
            for &target in self.row(row) {
                let parent = &mut parents[target as usize];
                *parent = if *parent == u32::MAX { state } else { *parent };
            }
        }
        parents
    }

    /// Memory in bytes, beside that in use, for growing the lists to `states` expanded states and `steps` more steps.
    pub(super) fn growth(&self, states: usize, steps: usize) -> u64 {
        let rows = states.saturating_sub(self.expanded());
        growth(&self.row_of, rows) + growth(&self.starts, rows) + growth(&self.targets, steps)
    }

    /// Memory in use in bytes, without the lists built on first use.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let numbers = self.row_of.capacity() + self.targets.capacity();
        ((self.arena.capacity() + self.starts.capacity()) * 8 + numbers * 4) as u64
    }
}
