//! The reachability graph as a search leaves it: states, steps in compressed rows, and what is missing.

use std::sync::OnceLock;

use fixedbitset::FixedBitSet;

use super::budget::Stop;
use super::space::Failure;
use super::store::Store;

/// A graph of states numbered in breadth-first order, so that a state's number never exceeds that of a state farther away.
pub struct Graph {
    pub(super) store: Store,
    /// The initial states.
    pub(super) initial: Vec<u32>,
    /// `targets[rows[s]..rows[s + 1]]` are the successors of state s.
    pub(super) rows: Vec<u64>,
    pub(super) targets: Vec<u32>,
    /// The state from which a state was first reached; its own number for an initial state.
    pub(super) parents: Vec<u32>,
    /// First state of each breadth-first level.
    pub(super) levels: Vec<u32>,
    /// States with a step that leads nowhere; `None` stands for the initial step.
    pub(super) failures: Vec<(Option<u32>, Failure)>,
    pub(super) stop: Stop,
    pub(super) backward: OnceLock<Rows>,
}

/// Rows of predecessors.
pub(super) struct Rows {
    rows: Vec<u64>,
    sources: Vec<u32>,
}

impl Graph {
    /// How many states there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.store.len()
    }

    /// Whether there is no state at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many steps are known.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.targets.len()
    }

    /// The words of a state.
    #[must_use]
    pub fn state(&self, id: u32) -> &[u64] {
        self.store.get(id)
    }

    /// The initial states.
    #[must_use]
    pub fn initial(&self) -> &[u32] {
        &self.initial
    }

    /// The numbers of all states.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = u32> + use<> {
        0..self.len() as u32
    }

    /// The known successors of a state, one for each step.
    #[must_use]
    pub fn successors(&self, id: u32) -> &[u32] {
        match (self.rows.get(id as usize), self.rows.get(id as usize + 1)) {
            (Some(&start), Some(&end)) => &self.targets[start as usize..end as usize],
            _ => &[],
        }
    }

    /// The known predecessors of a state, one for each step. The rows are built when first asked for.
    #[must_use]
    pub fn predecessors(&self, id: u32) -> &[u32] {
        let Rows { rows, sources } = self.backward.get_or_init(|| self.reverse());
        &sources[rows[id as usize] as usize..rows[id as usize + 1] as usize]
    }

    fn reverse(&self) -> Rows {
        let mut rows = vec![0_u64; self.len() + 1];
        for &target in &self.targets {
            rows[target as usize + 1] += 1;
        }
        for i in 1..rows.len() {
            rows[i] += rows[i - 1];
        }
        let mut next = rows.clone();
        let mut sources = vec![0; self.targets.len()];
        for source in self.ids() {
            for &target in self.successors(source) {
                sources[next[target as usize] as usize] = source;
                next[target as usize] += 1;
            }
        }
        Rows { rows, sources }
    }

    /// States not all of whose successors are known: not expanded, or with a step that fails.
    #[must_use]
    pub fn open(&self) -> FixedBitSet {
        let mut open = FixedBitSet::with_capacity(self.len());
        open.insert_range(self.expanded()..self.len());
        self.failures.iter().filter_map(|(state, _)| *state).for_each(|state| open.insert(state as usize));
        open
    }

    /// How many states were expanded; they are the first ones.
    #[must_use]
    pub fn expanded(&self) -> usize {
        self.rows.len() - 1
    }

    /// Whether all initial states are known.
    #[must_use]
    pub fn knows_initial(&self) -> bool {
        !self.initial.is_empty() && self.failures.iter().all(|(state, _)| state.is_some())
    }

    /// Steps that lead nowhere, each with the state it leaves; `None` stands for the step to an initial state.
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
        self.stop == Stop::Complete && self.failures.is_empty()
    }

    /// The largest of the shortest distances from an initial state, in steps.
    #[must_use]
    pub fn depth(&self) -> usize {
        self.levels.len().saturating_sub(1)
    }

    /// A shortest way from an initial state to a state, both included.
    #[must_use]
    pub fn path_to(&self, id: u32) -> Vec<u32> {
        let mut path = vec![id];
        let mut at = id;
        while self.parents[at as usize] != at {
            at = self.parents[at as usize];
            path.push(at);
        }
        path.reverse();
        path
    }

    /// Bytes in use, predecessors not counted.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let rows = self.rows.capacity() * 8 + self.targets.capacity() * 4 + self.parents.capacity() * 4;
        self.store.bytes() + rows as u64
    }
}
