//! Evaluation of a condition along a run, scan by scan, with the history it needs.

use petril_lang::semantics::VarId;
use petril_logic::{Bound, History, Past, Valuation, remembered};

/// Monitor of a condition on the end of a scan and possibly on earlier scans.
#[derive(Clone, Debug)]
pub struct Watch<'c> {
    condition: &'c Bound,
    history: History,
    /// Message from the last scan to the next one (see [`History`]).
    message: Vec<u64>,
}

impl<'c> Watch<'c> {
    /// Starts at power-on, with these values.
    #[must_use]
    pub fn new(condition: &'c Bound, power_on: &[u64]) -> Self {
        let history = History::of([condition]);
        let message = history.beginning(&|term, memory| {
            term.value_in(&Moment { values: power_on, history: &history, memory }).unwrap_or_default()
        });
        Self { condition, history, message }
    }

    /// Evaluates the condition at the end of a scan with these values.
    pub fn see(&mut self, values: &[u64]) -> bool {
        let history = &self.history;
        let mut memory = Vec::with_capacity(history.len());
        for position in 0..history.len() {
            let word = history.remember(position, &self.message, &Moment { values, history, memory: &memory });
            memory.push(word);
        }
        let now = Moment { values, history, memory: &memory };
        let is_true = self.condition.holds_in(&now) == Some(true);
        history.message(&now, &memory, &mut self.message);
        is_true
    }
}

/// Valuation at the end of a scan, or at power-on. Formulas bound for the scan view need nothing else.
struct Moment<'m> {
    values: &'m [u64],
    history: &'m History,
    /// Memory of the history, or as much of it as is computed already.
    memory: &'m [u64],
}

impl Valuation for Moment<'_> {
    fn value(&self, variable: VarId) -> u64 {
        self.values[variable.0]
    }

    fn past(&self, past: &Past) -> i128 {
        let word = self.history.position(past).and_then(|position| self.memory.get(position));
        debug_assert!(word.is_some(), "this is not remembered: {past:?}");
        remembered(word.copied().unwrap_or_default())
    }
}
