//! The reachability graph in compressed rows, made from kept states.

use super::exploration::Exploration;
use super::index::Index;
use super::shard::{Shard, owner};
use super::view::View;

/// Every step between the states of an exploration. States are numbered from 0, the initial one, in the order of their
/// distances from it. The numbers depend on the number of threads.
pub struct Steps {
    starts: Vec<u64>,
    targets: Vec<u32>,
    fired: Vec<u32>,
}

impl Steps {
    /// How many states there are.
    #[must_use]
    pub fn states(&self) -> usize {
        self.starts.len() - 1
    }

    /// Where the successors of each state begin, and last where they end; the successors of all states, one state after another;
    /// and the transitions that lead to them.
    #[must_use]
    pub fn into_parts(self) -> (Vec<u64>, Vec<u32>, Vec<u32>) {
        (self.starts, self.targets, self.fired)
    }

    /// The successors of a state, one for each transition it enables.
    #[must_use]
    pub fn successors(&self, state: u32) -> &[u32] {
        &self.targets[self.starts[state as usize] as usize..self.starts[state as usize + 1] as usize]
    }

    /// The transitions that lead to the successors, in the same order; empty if they were not asked for.
    #[must_use]
    pub fn fired(&self, state: u32) -> &[u32] {
        let row = self.starts[state as usize] as usize..self.starts[state as usize + 1] as usize;
        self.fired.get(row).unwrap_or_default()
    }
}

/// Steps whose targets are looked up together.
const TOGETHER: usize = 256;

impl Exploration {
    /// Shows every state kept, by number.
    pub fn for_each_state(&self, mut visit: impl FnMut(u32, &View<'_>)) {
        let machine = &self.machine;
        let (mut words, mut enabled) = (vec![0; machine.packing.words()], vec![0; machine.width]);
        let mut id = 0;
        for (shard, range) in self.runs() {
            let shard = &self.shards[shard];
            let mut numbers = shard.numbers();
            for position in range {
                shard.unpack(position, &mut words, &mut numbers);
                machine.enabled.put(&words, &mut enabled);
                visit(id, &View { packing: &machine.packing, words: &words, enabled: &enabled });
                id += 1;
            }
        }
    }

    /// All steps, with the transitions fired if asked for. Nothing if states were not kept, or not all of them are known.
    #[must_use]
    pub fn steps(&self, with_transitions: bool) -> Option<Steps> {
        if self.figures.expanded < self.figures.states {
            return None;
        }
        self.rows(with_transitions, usize::MAX)
    }

    /// The steps of the states expanded, as far as there are at most so many: rows of the first states, whole ones. Nothing
    /// unless states were kept, on one thread, so that those expanded are the first.
    pub(in crate::explore) fn steps_within(&self, most: usize) -> Option<Steps> {
        if self.shards.len() == 1 { self.rows(false, most) } else { None }
    }

    fn rows(&self, with_transitions: bool, most: usize) -> Option<Steps> {
        if self.shards.is_empty() || self.figures.states > u64::from(u32::MAX) {
            return None;
        }
        let indices = self.indices();
        let mut steps = Steps { starts: vec![0], targets: Vec::new(), fired: Vec::new() };
        steps.targets.reserve_exact(most.min(self.figures.transitions as usize));
        let mut found: Vec<Vec<(u64, usize)>> = vec![Vec::new(); self.shards.len()];
        let mut after = vec![0; self.machine.packing.words()];
        let mut keys = Vec::new();
        self.for_each_state(|state, view| {
            let enabled: u32 = view.enabled.iter().map(|word| word.count_ones()).sum();
            let is_next = steps.states() == state as usize && u64::from(state) < self.figures.expanded;
            if !is_next || enabled as usize > most - steps.targets.len() {
                return;
            }
            for transition in view.enabled() {
                after.copy_from_slice(view.words);
                self.machine.fire(transition, &mut after);
                let owner = owner(&after, self.shards.len());
                let at = steps.targets.len();
                steps.targets.push(u32::MAX);
                if with_transitions {
                    steps.fired.push(transition as u32);
                }
                if let Some(key) = self.shards[owner].key(&after) {
                    found[owner].push((key, at));
                }
                if found[owner].len() == TOGETHER {
                    resolve(&indices[owner], &mut found[owner], &mut keys, &mut steps.targets);
                }
            }
            steps.starts.push(steps.targets.len() as u64);
        });
        for (index, found) in indices.iter().zip(&mut found) {
            resolve(index, found, &mut keys, &mut steps.targets);
        }
        Some(steps)
    }

    /// Which positions of which shards the states have, in the order of their numbers.
    fn runs(&self) -> impl Iterator<Item = (usize, std::ops::Range<usize>)> {
        let levels = self.shards.first().map_or(0, |shard| shard.levels.len());
        let run = move |level| self.shards.iter().map(move |shard| shard.level(level)).enumerate();
        (0..=levels).flat_map(run)
    }

    /// For each shard the numbers of its keys.
    fn indices(&self) -> Vec<Index> {
        let index = |(number, shard): (usize, &Shard)| {
            Index::of(shard.bits(), shard.len(), &|add| {
                let mut id = 0;
                for (owner, range) in self.runs() {
                    for position in range {
                        if owner == number {
                            add(shard.narrow_key(position), id);
                        }
                        id += 1;
                    }
                }
            })
        };
        self.shards.iter().enumerate().map(index).collect()
    }
}

/// Replaces targets, given by their keys and where they stand, by their numbers.
fn resolve(index: &Index, found: &mut Vec<(u64, usize)>, keys: &mut Vec<u64>, targets: &mut [u32]) {
    keys.clear();
    keys.extend(found.iter().map(|&(key, _)| key));
    index.find(keys, |position, id| targets[found[position].1] = id);
    found.clear();
}
