//! Log of a reduction, from which runs of the reduced net are lifted to runs of the original.
//!
//! Most rules need no entry: a run of the reduced net is a run of the original as it stands. Transitions made by
//! agglomeration stand for sequences of others. Rules that need more log a [`Step`]. Transitions are numbered in
//! ascending order, so a step only records how many there were: later ones are written out before the step is undone.

use super::draft::{Draft, Row};

/// Log of a reduction, in order of time.
#[derive(Clone, Debug, Default)]
pub struct Log {
    /// Number of transitions of the original.
    pub originals: usize,
    /// Sequence of transitions that each added transition stands for; added ones are numbered from `originals`.
    pub words: Vec<Box<[u32]>>,
    /// Steps, each with the number of transitions made until then, removed ones included.
    pub steps: Vec<(usize, Step)>,
}

/// A step of a reduction that is undone when a run is lifted.
#[derive(Clone, Debug)]
pub enum Step {
    /// The transition was fired `times` times in the initial marking.
    Begun { transition: u32, times: u64 },
    /// In a dead marking the transitions `last` have yet to fire as often as possible: only firings that later ones
    /// need were kept.
    Finished { last: Vec<u32>, around: Around },
    /// Places were fused between which tokens move freely, by moves (position from, position to, transition).
    Fused { moves: Vec<(usize, usize, u32)>, around: Around },
    /// The transition fires first, often enough for all that follows.
    Supplied { transition: u32, around: Around },
}

/// Snapshot of some places and all transitions adjacent to them.
#[derive(Clone, Debug, Default)]
pub struct Around {
    /// Initial number of tokens of each place.
    pub tokens: Vec<u64>,
    /// Transitions, ascending, with their presets and postsets; places are positions in `tokens`.
    pub transitions: Vec<(u32, Row, Row)>,
}

impl Around {
    /// Takes a snapshot of places, given in ascending order, and of the transitions adjacent to them.
    pub fn of(draft: &Draft, places: &[u32]) -> Self {
        let mut transitions: Vec<u32> = places.iter().flat_map(|&place| draft.around(place)).collect();
        transitions.sort_unstable();
        transitions.dedup();
        let inside = |row: &Row| -> Row {
            let position = |&(place, weight): &(u32, u64)| Some((places.binary_search(&place).ok()? as u32, weight));
            row.iter().filter_map(position).collect()
        };
        let local = |&id: &u32| (id, inside(&draft.transition(id).pre), inside(&draft.transition(id).post));
        Self {
            tokens: places.iter().map(|&place| draft.place(place).tokens).collect(),
            transitions: transitions.iter().map(local).collect(),
        }
    }

    /// Preset and postset of a transition, as far as they are among the places.
    pub fn get(&self, transition: u32) -> Option<(&Row, &Row)> {
        let position = self.transitions.binary_search_by_key(&transition, |&(id, ..)| id).ok()?;
        let (_, pre, post) = &self.transitions[position];
        Some((pre, post))
    }
}

impl Log {
    pub fn new(originals: usize) -> Self {
        Self { originals, ..Self::default() }
    }

    /// Logs the sequence of transitions that the next added transition stands for.
    pub fn word(&mut self, word: &[u32]) {
        self.words.push(word.into());
    }

    /// Logs a step.
    pub fn step(&mut self, step: Step) {
        self.steps.push((self.originals + self.words.len(), step));
    }

    /// Sequence of transitions that a transition stands for; `None` for a transition of the original.
    pub fn meaning(&self, transition: u32) -> Option<&[u32]> {
        let position = (transition as usize).checked_sub(self.originals)?;
        self.words.get(position).map(|word| &**word)
    }
}
