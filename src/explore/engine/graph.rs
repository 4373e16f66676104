//! The reachability graph in compressed rows, made from kept states.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::exploration::Exploration;
use super::index::Index;
use super::numbering::Stretch;
use super::shard::owner;

/// The steps between the states of an exploration. States are numbered from 0, the initial one, in the order of their
/// distances from it. The numbers depend on the number of threads.
pub struct Steps {
    starts: Vec<u64>,
    targets: Vec<u32>,
}

impl Steps {
    /// How many states there are.
    #[must_use]
    pub fn states(&self) -> usize {
        self.starts.len() - 1
    }

    /// Where the successors of each state begin, and last where they end; and the successors of all states, one state after
    /// another.
    #[must_use]
    pub fn into_parts(self) -> (Vec<u64>, Vec<u32>) {
        (self.starts, self.targets)
    }

    /// The successors of a state, one for each transition it enables, in their order. The number of states stands for a
    /// successor that was not kept.
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
    /// All steps of the states kept, found on all processors. Nothing if there are no states, or too many to be numbered, or
    /// `stopping` is set meanwhile.
    #[must_use]
    pub fn steps(&self, stopping: &AtomicBool) -> Option<Steps> {
        let states = self.kept();
        if states == 0 || states >= u32::MAX as usize {
            return None;
        }
        let stretches = self.stretches();
        let mut starts = vec![0; states + 1];
        starts[1..].par_chunks_mut(BLOCK).enumerate().for_each(|(block, counts)| {
            let first = (block * BLOCK) as u32;
            self.visit(&stretches, first..first + counts.len() as u32, |number, _, view, _| {
                counts[(number - first) as usize] = view.enabled.iter().map(|word| u64::from(word.count_ones())).sum();
            });
        });
        for state in 0..states {
            starts[state + 1] += starts[state];
        }
        let indices = self.indices(&stretches);
        let mut targets = vec![0; starts[states] as usize];
        let mut blocks = Vec::with_capacity(states.div_ceil(BLOCK));
        let mut rest = &mut targets[..];
        for first in (0..states).step_by(BLOCK) {
            let end = states.min(first + BLOCK);
            let (block, more) = std::mem::take(&mut rest).split_at_mut((starts[end] - starts[first]) as usize);
            blocks.push((first as u32..end as u32, block));
            rest = more;
        }
        blocks.into_par_iter().for_each(|(numbers, targets)| {
            if !stopping.load(Ordering::Relaxed) {
                self.steps_of(numbers, &stretches, &indices, targets);
            }
        });
        (!stopping.load(Ordering::Relaxed)).then_some(Steps { starts, targets })
    }

    /// The steps of the states expanded, as far as there are at most so many: rows of the first states, whole ones. Nothing
    /// unless states were kept, on one thread, so that those expanded are the first.
    pub(in crate::explore) fn steps_within(&self, most: usize) -> Option<Steps> {
        if self.shards.len() != 1 {
            return None;
        }
        let mut steps = self.steps(&AtomicBool::new(false))?;
        steps.starts.truncate(self.figures.expanded as usize + 1);
        let fitting = steps.starts.partition_point(|&start| start <= most as u64);
        steps.starts.truncate(fitting.max(1));
        steps.targets.truncate(steps.starts[steps.starts.len() - 1] as usize);
        Some(steps)
    }

    /// Puts the successors of some states into `targets`.
    fn steps_of(&self, numbers: Range<u32>, stretches: &[Stretch], indices: &[Index], targets: &mut [u32]) {
        let machine = &self.machine;
        let mut found: Vec<Vec<(u64, usize)>> = vec![Vec::with_capacity(TOGETHER); self.shards.len()];
        let mut after = vec![0; machine.packing.words()];
        let mut keys = Vec::with_capacity(TOGETHER);
        let mut nodes_after = Vec::new();
        let mut at = 0;
        targets.fill(self.kept() as u32);
        self.visit(stretches, numbers, |_, shard, view, nodes| {
            for transition in view.enabled() {
                after.copy_from_slice(view.words);
                machine.fire(transition, &mut after);
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
    fn indices(&self, stretches: &[Stretch]) -> Vec<Index> {
        let index = |shard: usize| {
            let states = &self.shards[shard];
            Index::of(states.bits(), states.len(), &|add| {
                for stretch in stretches.iter().filter(|stretch| stretch.shard == shard) {
                    let positions = stretch.positions.clone();
                    positions.zip(stretch.first..).for_each(|(at, number)| add(states.narrow_key(at), number));
                }
            })
        };
        (0..self.shards.len()).into_par_iter().map(index).collect()
    }
}

/// Replaces targets, given by their keys and where they stand, by their numbers.
fn resolve(index: &Index, found: &mut Vec<(u64, usize)>, keys: &mut Vec<u64>, targets: &mut [u32]) {
    keys.clear();
    keys.extend(found.iter().map(|&(key, _)| key));
    index.find(keys, |position, id| targets[found[position].1] = id);
    found.clear();
}
