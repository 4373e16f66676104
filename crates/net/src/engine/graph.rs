//! The reachability graph in compressed sparse rows, made from kept states.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::exploration::Exploration;
use super::index::Index;
use super::numbering::Stretch;
use super::shard::owner;

/// Steps from the expanded states of an exploration. States are numbered from 0, the initial one, by their distance
/// from it, expanded ones first. The numbers depend on the number of threads.
pub struct Steps {
    starts: Vec<u64>,
    targets: Vec<u32>,
}

impl Steps {
    /// Number of states with a row: the expanded ones, or the first of these if rows were limited.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Returns the start of each state's successors, followed by the end of the last, and the successors of all states
    /// in order.
    #[must_use]
    pub fn into_parts(self) -> (Vec<u64>, Vec<u32>) {
        (self.starts, self.targets)
    }

    /// Successors of an expanded state, one for each enabled transition, in the order of transitions. The number of
    /// states kept stands for a successor that was not kept.
    #[must_use]
    pub fn successors(&self, state: u32) -> &[u32] {
        &self.targets[self.starts[state as usize] as usize..self.starts[state as usize + 1] as usize]
    }
}

/// Number of steps whose targets are looked up together.
const TOGETHER: usize = 256;

/// Number of states whose steps are found by one thread at a time.
const BLOCK: usize = 1 << 13;

impl Exploration {
    /// Computes all steps of the expanded states, on all processors. `None` if there are no states, or too many to be
    /// numbered, or too little memory, or `stopping` is set meanwhile.
    #[must_use]
    pub fn steps(&self, stopping: &AtomicBool) -> Option<Steps> {
        self.steps_within(usize::MAX, stopping)
    }

    /// Computes steps as [`Self::steps`] does, but only the rows of the first states with at most `most` steps in
    /// total.
    pub(crate) fn steps_within(&self, most: usize, stopping: &AtomicBool) -> Option<Steps> {
        let states = self.kept();
        if states == 0 || states >= u32::MAX as usize {
            return None;
        }
        let stretches = self.stretches();
        let mut starts = self.counted(stretches, stopping)?;
        starts.truncate(starts.partition_point(|&start| start <= most as u64));
        let rows = starts.len() - 1;
        let indices = self.indices(stretches, stopping)?;
        let mut targets = filled(states as u32, starts[rows] as usize)?;
        let mut blocks = Vec::with_capacity(rows.div_ceil(BLOCK));
        let mut rest = &mut targets[..];
        for first in (0..rows).step_by(BLOCK) {
            let end = rows.min(first + BLOCK);
            let (block, more) = std::mem::take(&mut rest).split_at_mut((starts[end] - starts[first]) as usize);
            blocks.push((first as u32..end as u32, block));
            rest = more;
        }
        blocks.into_par_iter().for_each(|(numbers, targets)| {
            if !stopping.load(Ordering::Relaxed) {
                self.steps_of(numbers, stretches, &indices, targets);
            }
        });
        (!stopping.load(Ordering::Relaxed)).then_some(Steps { starts, targets })
    }

    /// Offsets of the steps of each expanded state.
    fn counted(&self, stretches: &[Stretch], stopping: &AtomicBool) -> Option<Vec<u64>> {
        let mut starts = filled(0_u64, self.expanded() + 1)?;
        starts[1..].par_chunks_mut(BLOCK).enumerate().for_each(|(block, counts)| {
            let first = (block * BLOCK) as u32;
            if !stopping.load(Ordering::Relaxed) {
                self.visit(stretches, first..first + counts.len() as u32, |number, _, view, _| {
                    counts[(number - first) as usize] =
                        view.enabled.iter().map(|word| u64::from(word.count_ones())).sum();
                });
            }
        });
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        (!stopping.load(Ordering::Relaxed)).then_some(starts)
    }

    /// Writes the successors of expanded states into `targets`, which are preset to the number that stands for states
    /// not kept.
    fn steps_of(&self, numbers: Range<u32>, stretches: &[Stretch], indices: &[Index], targets: &mut [u32]) {
        let machine = &self.machine;
        let mut found: Vec<Vec<(u64, usize)>> = vec![Vec::with_capacity(TOGETHER); self.shards.len()];
        let mut after = vec![0; machine.packing.words()];
        let mut keys = Vec::with_capacity(TOGETHER);
        let mut nodes_after = Vec::new();
        let mut at = 0;
        self.visit(stretches, numbers, |_, shard, view, nodes| {
            for transition in view.enabled() {
                after.copy_from_slice(view.words);
                // No enabled transition of an expanded state overflows; if one did, its successor would be unknown.
                if !machine.fire(transition, &mut after) {
                    at += 1;
                    continue;
                }
                let owner = owner(&after, self.shards.len());
                let key = if owner == shard {
                    self.shards[owner].key_after(&after, machine.changes.get(transition), nodes, &mut nodes_after)
                } else {
                    self.shards[owner].key(&after)
                };
                if let Some(key) = key {
                    found[owner].push((key, at));
                }
                at += 1;
                if found[owner].len() == TOGETHER {
                    resolve(&indices[owner], &mut found[owner], &mut keys, targets);
                }
            }
        });
        for (index, found) in indices.iter().zip(&mut found) {
            resolve(index, found, &mut keys, targets);
        }
    }

    /// Index of the keys of each shard.
    fn indices(&self, stretches: &[Stretch], stopping: &AtomicBool) -> Option<Vec<Index>> {
        let index = |shard: usize| {
            let states = &self.shards[shard];
            Index::of(states.bits(), states.len(), &|add| {
                for stretch in stretches.iter().filter(|stretch| stretch.shard == shard) {
                    for block in (0..stretch.positions.len()).step_by(BLOCK) {
                        if stopping.load(Ordering::Relaxed) {
                            return;
                        }
                        let positions = stretch.positions.clone().zip(stretch.first..).skip(block).take(BLOCK);
                        positions.for_each(|(at, number)| add(states.narrow_key(at), number));
                    }
                }
            })
        };
        (0..self.shards.len()).into_par_iter().map(index).collect()
    }
}

/// List of equal values; `None` if there is too little memory.
fn filled<T: Clone>(value: T, len: usize) -> Option<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(len).ok()?;
    list.resize(len, value);
    Some(list)
}

/// Looks up targets by their keys, and writes their numbers at their positions.
fn resolve(index: &Index, found: &mut Vec<(u64, usize)>, keys: &mut Vec<u64>, targets: &mut [u32]) {
    keys.clear();
    keys.extend(found.iter().map(|&(key, _)| key));
    index.find(keys, |position, id| targets[found[position].1] = id);
    found.clear();
}
