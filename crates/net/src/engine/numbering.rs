//! Numbering of the states kept: 0 for the initial one, the others by their distance from it. On any number of threads
//! the states that were not expanded come last: of those at one distance, the expanded ones come first.

use std::ops::Range;

use super::exploration::Exploration;
use super::shard::Shard;
use super::view::View;

/// Consecutively numbered states of one shard.
pub(super) struct Stretch {
    /// Number of the first state.
    pub(super) first: u32,
    pub(super) shard: usize,
    /// Positions of the states in the shard.
    pub(super) positions: Range<usize>,
}

impl Exploration {
    /// Number of states kept.
    #[must_use]
    pub fn kept(&self) -> usize {
        self.shards.iter().map(Shard::len).sum()
    }

    /// Number of states kept that were expanded; these come first.
    #[must_use]
    pub fn expanded(&self) -> usize {
        self.shards.iter().map(Shard::expanded).sum()
    }

    /// Stretches of all states in the order of their numbers.
    pub(super) fn stretches(&self) -> &[Stretch] {
        self.stretches.get_or_init(|| self.numbered())
    }

    fn numbered(&self) -> Vec<Stretch> {
        let levels = self.shards.first().map_or(0, |shard| shard.levels.len());
        let mut stretches: Vec<Stretch> = Vec::new();
        let mut first = 0;
        let mut add = |shard, positions: Range<usize>| {
            let length = positions.len() as u32;
            match stretches.last_mut() {
                _ if length == 0 => {}
                // A graph may have many levels, most of them small.
                Some(last) if last.shard == shard && last.positions.end == positions.start => {
                    last.positions.end = positions.end;
                }
                _ => stretches.push(Stretch { first, shard, positions }),
            }
            first += length;
        };
        for level in 0..=levels {
            let level = |states: &Shard| {
                let all = states.level(level);
                let split = states.expanded().clamp(all.start, all.end);
                (all.start..split, split..all.end)
            };
            self.shards.iter().enumerate().for_each(|(shard, states)| add(shard, level(states).0));
            self.shards.iter().enumerate().for_each(|(shard, states)| add(shard, level(states).1));
        }
        stretches
    }

    /// Calls `visit` with every state kept, in the order of numbers.
    pub fn for_each_state(&self, visit: impl FnMut(u32, &View<'_>)) {
        self.for_states(0..self.kept() as u32, visit);
    }

    /// Calls `visit` with the states of a range of numbers.
    pub fn for_states(&self, numbers: Range<u32>, mut visit: impl FnMut(u32, &View<'_>)) {
        self.visit(self.stretches(), numbers, |number, _, view, _| visit(number, view));
    }

    /// Marking of a state.
    #[must_use]
    pub fn marking(&self, number: u32) -> Option<Vec<u64>> {
        let mut marking = None;
        if (number as usize) < self.kept() {
            self.for_states(number..number + 1, |_, view| marking = Some(view.marking()));
        }
        marking
    }

    /// Calls `visit` with the states of a range of numbers, each with its shard and the numbers of its compression-tree
    /// nodes.
    pub(super) fn visit(
        &self,
        stretches: &[Stretch],
        numbers: Range<u32>,
        mut visit: impl FnMut(u32, usize, &View<'_>, &[u32]),
    ) {
        let machine = &self.machine;
        let (mut words, mut enabled) = (vec![0; machine.packing.words()], vec![0; machine.width]);
        let begin = stretches.partition_point(|stretch| stretch.first <= numbers.start).saturating_sub(1);
        for stretch in &stretches[begin..] {
            if stretch.first >= numbers.end {
                return;
            }
            let shard = &self.shards[stretch.shard];
            let mut nodes = shard.numbers();
            let skipped = numbers.start.saturating_sub(stretch.first);
            let end = numbers.end - stretch.first;
            for (position, number) in stretch.positions.clone().zip(0..end).skip(skipped as usize) {
                shard.unpack(position, &mut words, &mut nodes);
                machine.enabled.put(&words, &mut enabled);
                let view = View { packing: &machine.packing, words: &words, enabled: &enabled };
                visit(stretch.first + number, stretch.shard, &view, &nodes);
            }
        }
    }
}
