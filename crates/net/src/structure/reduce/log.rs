//! What has to be known to turn runs of the reduced net back into runs of the original.
//!
//! Most rules ask for nothing: a run is a run of the original as it stands. Transitions made by agglomeration stand for others,
//! one after the other. Whatever asks for more is a [`Step`]. Numbers of transitions only grow, so a step needs to know only how
//! many there were: those that came later are written out before it is undone.

use super::draft::{Draft, Row};

/// All of it, in the order in which it happened.
#[derive(Clone, Debug, Default)]
pub struct Log {
    /// How many transitions the original has.
    pub originals: usize,
    /// What each further transition stands for; they are numbered from `originals`.
    pub words: Vec<Box<[u32]>>,
    /// Steps, each with how many transitions there were, gone or not.
    pub steps: Vec<(usize, Step)>,
}

/// What is done to a run when a rule is undone.
#[derive(Clone, Debug)]
pub enum Step {
    /// This transition was fired at the very beginning, so many times.
    Begun { transition: u32, times: u64 },
    /// In a dead marking these have yet to fire as often as they can: only the firings needed by what follows were kept.
    Finished { last: Vec<u32>, around: Around },
    /// Tokens move freely between these places, by transitions from one (position) to another.
    Fused { moves: Vec<(usize, usize, u32)>, around: Around },
    /// This transition fires at the very beginning, often enough for all that follows.
    Supplied { transition: u32, around: Around },
}

/// Some places and all transitions at them, as they were.
#[derive(Clone, Debug, Default)]
pub struct Around {
    /// The tokens of each place at the beginning.
    pub tokens: Vec<u64>,
    /// Transitions, ascending, with what they need and put; places are positions in `tokens`.
    pub transitions: Vec<(u32, Row, Row)>,
}

impl Around {
    /// Some places, ascending, and the transitions at them.
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

    /// What a transition needs and puts.
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

    /// Notes what the next transition stands for.
    pub fn word(&mut self, word: &[u32]) {
        self.words.push(word.into());
    }

    /// Notes a step.
    pub fn step(&mut self, step: Step) {
        self.steps.push((self.originals + self.words.len(), step));
    }

    /// What a transition stands for; nothing if it is one of the original.
    pub fn meaning(&self, transition: u32) -> Option<&[u32]> {
        let position = (transition as usize).checked_sub(self.originals)?;
        self.words.get(position).map(|word| &**word)
    }
}
