//! Valuations of atoms in packed states, for both views.

use crate::scans::ScanSpace;
use petril_base::PlaceId;
use petril_lang::semantics::VarId;
use petril_logic::{History, Past, Valuation, remembered};
use petril_search::Observer;

/// Valuation of a packed scan state. Formulas bound for the scan view contain variables, and fairness assumptions
/// places of the plant.
pub struct ScanValuation<'a>(pub &'a ScanSpace<'a>, pub &'a [u64]);

impl Valuation for ScanValuation<'_> {
    fn value(&self, variable: VarId) -> u64 {
        self.0.value(self.1, variable)
    }

    fn is_marked(&self, place: PlaceId) -> bool {
        self.0.is_marked(self.1, place)
    }
}

/// Valuation of a packed scan state with its memory of the past.
pub struct RememberingValuation<'a> {
    /// State space of the scan view.
    pub space: &'a ScanSpace<'a>,
    /// Packed state.
    pub state: &'a [u64],
    /// Terms about the past that are remembered.
    pub history: &'a History,
    /// Memory of the state, or the part computed so far.
    pub memory: &'a [u64],
}

impl Valuation for RememberingValuation<'_> {
    fn value(&self, variable: VarId) -> u64 {
        self.space.value(self.state, variable)
    }

    fn past(&self, past: &Past) -> i128 {
        let word = self.history.position(past).and_then(|position| self.memory.get(position));
        debug_assert!(word.is_some(), "this is not remembered: {past:?}");
        remembered(word.copied().unwrap_or_default())
    }

    fn is_marked(&self, place: PlaceId) -> bool {
        self.space.is_marked(self.state, place)
    }
}

/// Observer that evaluates terms about the past along scan states.
pub struct Remembering<'a> {
    /// State space of the scan view.
    pub space: &'a ScanSpace<'a>,
    /// Terms about the past that are remembered.
    pub history: &'a History,
}

impl<'a> Remembering<'a> {
    /// Valuation of a state with its memory.
    #[must_use]
    pub fn at(&self, state: &'a [u64], memory: &'a [u64]) -> RememberingValuation<'a> {
        RememberingValuation { space: self.space, state, history: self.history, memory }
    }
}

impl Observer for Remembering<'_> {
    fn len(&self) -> usize {
        self.history.len()
    }

    fn beginning(&self) -> Vec<u64> {
        let power_on = self.space.packed_power_on();
        self.history.beginning(&|term, memory| {
            let state = RememberingValuation { space: self.space, state: &power_on, history: self.history, memory };
            term.value_in(&state).unwrap_or_default()
        })
    }

    fn message(&self, state: &[u64], memory: &[u64], message: &mut Vec<u64>) {
        let state = RememberingValuation { space: self.space, state, history: self.history, memory };
        self.history.message(&state, memory, message);
    }

    fn remember(&self, message: &[u64], state: &[u64], memory: &mut Vec<u64>) {
        memory.clear();
        for position in 0..self.history.len() {
            let so_far = RememberingValuation { space: self.space, state, history: self.history, memory };
            let word = self.history.remember(position, message, &so_far);
            memory.push(word);
        }
    }
}
