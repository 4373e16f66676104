//! Numbers for the states kept: 0 for the initial one, and the others in the order of their distances from it.

use std::ops::Range;

use super::exploration::Exploration;
use super::shard::Shard;
use super::view::View;

/// States of one shard that follow each other.
pub(super) struct Stretch {
    /// The number of the first.
    pub(super) first: u32,
    pub(super) shard: usize,
    /// Their positions in the shard.
    pub(super) positions: Range<usize>,
}

impl Exploration {
    /// How many states were kept.
    #[must_use]
    pub fn kept(&self) -> usize {
        self.shards.iter().map(Shard::len).sum()
    }

    /// All states in the order of their numbers.
    pub(super) fn stretches(&self) -> Vec<Stretch> {
        let levels = self.shards.first().map_or(0, |shard| shard.levels.len());
        let mut stretches = Vec::new();
        let mut first = 0;
        for level in 0..=levels {
            for (shard, states) in self.shards.iter().enumerate() {
                let positions = states.level(level);
                if !positions.is_empty() {
                    let length = positions.len() as u32;
                    stretches.push(Stretch { first, shard, positions });
                    first += length;
                }
            }
        }
        stretches
    }

    /// Shows every state kept, by number.
    pub fn for_each_state(&self, visit: impl FnMut(u32, &View<'_>)) {
        self.for_states(0..self.kept() as u32, visit);
    }

    /// Shows the states with these numbers.
    pub fn for_states(&self, numbers: Range<u32>, mut visit: impl FnMut(u32, &View<'_>)) {
        self.visit(&self.stretches(), numbers, |number, _, view, _| visit(number, view));
    }

    /// The tokens of a state.
    #[must_use]
    pub fn marking(&self, number: u32) -> Option<Vec<u64>> {
        let mut marking = None;
        if (number as usize) < self.kept() {
            self.for_states(number..number + 1, |_, view| marking = Some(view.marking()));
        }
        marking
    }

    /// Shows the states with these numbers: each with its shard, and the numbers of the nodes of its fold.
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
