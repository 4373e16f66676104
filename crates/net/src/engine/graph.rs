//! The reachability graph in compressed rows, made from kept states.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::exploration::Exploration;
use super::index::Index;
use super::numbering::Stretch;
use super::shard::owner;

/// The steps from the expanded states of an exploration. States are numbered from 0, the initial one, in the order of their
/// distances from it, and the expanded ones first. The numbers depend on the number of threads.
pub struct Steps {
    starts: Vec<u64>,
    targets: Vec<u32>,
}

impl Steps {
    /// Number of states with a row: the expanded ones, as far as steps were asked for.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Where the successors of each of these states begin, and last where they end; and all successors, one state after another.
    #[must_use]
    pub fn into_parts(self) -> (Vec<u64>, Vec<u32>) {
        (self.starts, self.targets)
    }

    /// The successors of an expanded state, one for each transition it enables, in their order. The number of states kept
    /// stands for a successor that was not kept.
    #[must_use]
    pub fn successors(&self, state: u32) -> &[u32] {
        &self.targets[self.starts[state as usize] as usize..self.starts[state as usize + 1] as usize]
    }
}

/// Steps whose targets are looked up together.
const TOGETHER: usize = 256;

/// States whose steps are found by one thread at a time.
const BLOCK: usize = 1 << 13;

impl Exploration {
    /// All steps of the expanded states, found on all processors. Nothing if there are no states, or too many to be numbered,
    /// or too little memory, or `stopping` is set meanwhile.
    #[must_use]
    pub fn steps(&self, stopping: &AtomicBool) -> Option<Steps> {
        self.steps_within(usize::MAX, stopping)
    }

    /// As [`Self::steps`], but only the rows of the first states that together have at most `most` steps.
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

    /// Where the steps of each expanded state begin.
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

    /// Puts the successors of some expanded states into `targets`, which hold the number that stands for others.
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
                // An expanded state fires all it enables; were it otherwise, its successor would not be known.
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

    /// For each shard the numbers of its keys.
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

/// A list of equal numbers; nothing if there is too little memory.
fn filled<T: Clone>(value: T, len: usize) -> Option<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(len).ok()?;
    list.resize(len, value);
    Some(list)
}

/// Replaces targets, given by their keys and where they stand, by their numbers.
fn resolve(index: &Index, found: &mut Vec<(u64, usize)>, keys: &mut Vec<u64>, targets: &mut [u32]) {
    keys.clear();
    keys.extend(found.iter().map(|&(key, _)| key));
    index.find(keys, |position, id| targets[found[position].1] = id);
    found.clear();
}
