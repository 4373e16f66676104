//! The reachability graph as a search leaves it: states, steps in compressed rows, and what is missing.
//!
//! States whose steps lead to the same states share one row: at the end of a scan, all states that differ in inputs only.

use std::sync::OnceLock;

use fixedbitset::FixedBitSet;

use super::budget::Stop;
use super::space::Failure;
use super::store::growth;
use crate::rows::Rows;

/// A graph of states numbered in breadth-first order, so that a state's number never exceeds that of a state farther away.
pub struct Graph {
    /// The states' words, one state after another; nothing if they are kept elsewhere.
    pub(super) arena: Vec<u64>,
    pub(super) words: usize,
    pub(super) len: usize,
    /// The initial states.
    pub(super) initial: Vec<u32>,
    /// The row of each expanded state, which are the first ones.
    pub(super) row_of: Vec<u32>,
    /// `targets[starts[r]..starts[r + 1]]` is row r.
    pub(super) starts: Vec<u64>,
    pub(super) targets: Vec<u32>,
    /// First state of each breadth-first level.
    pub(super) levels: Vec<u32>,
    /// States with a step that leads nowhere: of each row its first state, once for each failure; `None` stands for the
    /// initial step.
    pub(super) failures: Vec<(Option<u32>, Failure)>,
    /// States of which not all steps are known, beside those that were not expanded and those with a step that leads nowhere.
    pub(super) cut: Vec<u32>,
    pub(super) stop: Stop,
    pub(super) members: OnceLock<Rows<u32>>,
    pub(super) backward: OnceLock<Rows<u32>>,
    /// The state from which a state was first reached; its own number for an initial state.
    pub(super) parents: OnceLock<Vec<u32>>,
}

impl Graph {
    /// The graph of `states` states that are kept elsewhere: state 0 is the initial one, the first states are expanded, and
    /// `targets[starts[s]..starts[s + 1]]` are the successors of such a state s.
    ///
    /// Unless the graph is the whole one, which `stop` says, a last state is added that stands for all that are not known, with the
    /// number that targets give it.
    #[must_use]
    pub fn of_rows(states: usize, starts: Vec<u64>, targets: Vec<u32>, stop: Stop) -> Self {
        let rows = starts.len().saturating_sub(1) as u32;
        let len = states + usize::from(stop != Stop::Complete || (rows as usize) < states);
        let (initial, row_of) = ((0..states.min(1) as u32).collect(), (0..rows).collect());
        Self { len, initial, row_of, starts, targets, stop, ..Self::empty(0) }
    }

    /// The graph of states that are kept elsewhere, some of which share rows: see [`followed`](super::followed).
    pub(super) fn of_pairs(initial: Vec<u32>, row_of: Vec<u32>, starts: Vec<u64>, targets: Vec<u32>) -> Self {
        Self { len: row_of.len(), initial, row_of, starts, targets, ..Self::empty(0) }
    }

    /// No states yet, of this many words.
    pub(super) fn empty(words: usize) -> Self {
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

    /// How many states there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no state at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many steps are known, counted for each state.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.row_of.iter().map(|&row| self.row(row).len() as u64).sum()
    }

    /// The words of a state.
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

    /// The numbers of all states.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = u32> + Clone + use<> {
        0..self.len() as u32
    }

    /// The known successors of a state, one for each step.
    #[must_use]
    pub fn successors(&self, id: u32) -> &[u32] {
        self.row_of.get(id as usize).map_or(&[], |&row| self.row(row))
    }

    /// How many rows there are.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// The row of a state, if it was expanded.
    #[must_use]
    pub fn row_of(&self, id: u32) -> Option<u32> {
        self.row_of.get(id as usize).copied()
    }

    /// A row: the successors of all states that have it.
    #[must_use]
    pub fn row(&self, row: u32) -> &[u32] {
        &self.targets[self.starts[row as usize] as usize..self.starts[row as usize + 1] as usize]
    }

    /// The states that have a row, ascending. The lists are built when first asked for.
    #[must_use]
    pub fn members(&self, row: u32) -> &[u32] {
        let pairs = || self.row_of.iter().zip(0..).map(|(&row, state)| (row as usize, state));
        &self.members.get_or_init(|| Rows::group(self.rows(), pairs()))[row as usize]
    }

    /// The rows that hold a state, once for each step. The lists are built when first asked for.
    #[must_use]
    pub fn rows_to(&self, id: u32) -> &[u32] {
        let rows = 0..self.rows() as u32;
        let pairs = || rows.clone().flat_map(|row| self.row(row).iter().map(move |&target| (target as usize, row)));
        &self.backward.get_or_init(|| Rows::group(self.len(), pairs()))[id as usize]
    }

    /// States not all of whose successors are known: not expanded, or with a step that fails.
    #[must_use]
    pub fn open(&self) -> FixedBitSet {
        let mut open = FixedBitSet::with_capacity(self.len());
        open.insert_range(self.expanded()..self.len());
        let failing = self.failures.iter().filter_map(|(state, _)| self.row_of((*state)?));
        failing.flat_map(|row| self.members(row)).for_each(|&state| open.insert(state as usize));
        self.cut.iter().for_each(|&state| open.insert(state as usize));
        open
    }

    /// How many states were expanded; they are the first ones.
    #[must_use]
    pub fn expanded(&self) -> usize {
        self.row_of.len()
    }

    /// Whether all initial states are known.
    #[must_use]
    pub fn knows_initial(&self) -> bool {
        !self.initial.is_empty() && self.failures.iter().all(|(state, _)| state.is_some())
    }

    /// Steps that lead nowhere, each with a state it leaves, nearest first; `None` stands for the step to an initial state.
    #[must_use]
    pub fn failures(&self) -> &[(Option<u32>, Failure)] {
        &self.failures
    }

    /// Why the search ended.
    #[must_use]
    pub fn stop(&self) -> &Stop {
        &self.stop
    }

    /// Whether every reachable state and step is in the graph.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.stop == Stop::Complete && self.failures.is_empty() && self.cut.is_empty()
    }

    /// The largest of the shortest distances from an initial state, in steps.
    #[must_use]
    pub fn depth(&self) -> usize {
        self.levels.len().saturating_sub(1)
    }

    /// A shortest way from an initial state to a state, both included.
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

    /// For each state the first one with a step to it. As rows are in the order of distances, that is one of the nearest.
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

    /// Bytes that its lists take at once, beside those in use, if all of so many states are expanded and so many steps added.
    pub(super) fn growth(&self, states: usize, steps: usize) -> u64 {
        let rows = states.saturating_sub(self.expanded());
        growth(&self.row_of, rows) + growth(&self.starts, rows) + growth(&self.targets, steps)
    }

    /// Bytes in use, without the lists that are built when asked for.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let numbers = self.row_of.capacity() + self.targets.capacity();
        ((self.arena.capacity() + self.starts.capacity()) * 8 + numbers * 4) as u64
    }
}
