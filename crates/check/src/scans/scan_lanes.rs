//! Batches of scans for a [`Circuit`]: collected until a batch is full, run together, and returned to their states.

use super::scan_space::ScanSpace;
use crate::scans::Failure;
use petril_lang::circuit::{Circuit, LANES, Scratch};
use petril_search::{Step, Successors};

/// Batch of scans not yet run. One scan of each batch is confirmed by the interpreter.
pub(super) struct Lanes<'s> {
    space: &'s ScanSpace<'s>,
    circuit: &'s Circuit,
    /// Number of words of a state.
    words: usize,
    /// States in which the scans begin.
    states: Vec<u64>,
    /// Numbers of lanes, ascending, after which the steps out of a state are complete.
    ends: Vec<usize>,
    scratch: Scratch,
}

impl<'s> Lanes<'s> {
    pub(super) fn new(space: &'s ScanSpace<'s>, circuit: &'s Circuit, words: usize) -> Self {
        let states = Vec::with_capacity(LANES * words);
        Self { space, circuit, words, states, ends: Vec::new(), scratch: Scratch::default() }
    }

    /// Adds a scan from the current state.
    pub(super) fn add(&mut self, begin: &[u64], into: &mut Successors) {
        self.states.extend_from_slice(begin);
        if self.states.len() == LANES * self.words {
            self.run(into);
        }
    }

    /// Ends the scans from the current state.
    pub(super) fn finish(&mut self) {
        self.ends.push(self.states.len() / self.words);
    }

    /// Runs the scans of the batch.
    pub(super) fn run(&mut self, into: &mut Successors) {
        let begin = self.states.get(..self.words).map(<[u64]>::to_vec);
        let mut failures: Vec<(usize, Failure)> = Vec::new();
        self.circuit.run(&mut self.states, &mut self.scratch, |lane, line, hazard| {
            failures.push((lane, Failure::Hazard(line, hazard)));
        });
        if let Some(begin) = begin {
            let end = match failures.first() {
                Some(&(0, failure)) => Err(failure),
                _ => Ok(&self.states[..self.words]),
            };
            self.space.confirm(&begin, end);
        }
        let (mut failures, mut ends) = (failures.into_iter().peekable(), self.ends.drain(..).peekable());
        for (lane, state) in self.states.chunks_exact(self.words).enumerate() {
            while ends.next_if_eq(&lane).is_some() {
                into.finish();
            }
            into.add(match failures.next_if(|failure| failure.0 == lane) {
                Some((_, failure)) => Step::Fails(failure.into()),
                None => Step::To(state),
            });
        }
        ends.for_each(|_| into.finish());
        self.states.clear();
    }
}
