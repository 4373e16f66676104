//! The scan view extended by the history that past-time formulas need.

use super::Trace;
use super::views::{ScanStates, ScanView, SystemView};
use crate::requirement::Remembering;
use crate::translate::System;
use crate::witness::{Disagreement, Holds, replay_scans, scan_trace};
use petril_logic::{Bound, History, remembered};
use petril_search::{Budget, Graph, Observer, Progress, observed};

/// The scan view with memory. A state's words are its number in the scan view and its memory.
pub struct RememberingView<'a, 's> {
    base: &'a ScanView<'s>,
    history: History,
    graph: Graph,
}

impl<'a, 's> RememberingView<'a, 's> {
    /// Builds the product of the scan view with the memory for this history.
    pub fn new(
        base: &'a ScanView<'s>,
        history: History,
        budget: Budget,
        watch: &mut dyn FnMut(&Progress) -> Option<String>,
    ) -> Self {
        let graph = observed(&base.graph, &Remembering { space: &base.space, history: &history }, budget, watch);
        Self { base, history, graph }
    }

    fn scan_state(&self, state: &[u64]) -> &[u64] {
        self.base.graph.state(state[0] as u32)
    }

    fn remembering(&self) -> Remembering<'_> {
        Remembering { space: &self.base.space, history: &self.history }
    }
}

impl ScanStates for RememberingView<'_, '_> {
    fn base(&self) -> &ScanView<'_> {
        self.base
    }

    fn parts<'a>(&'a self, state: &'a [u64]) -> (&'a [u64], &'a [u64]) {
        (self.scan_state(state), &state[1..])
    }

    fn remember(&self, before: Option<(&[u64], &[u64])>, end: &[u64]) -> Vec<u64> {
        let remembering = self.remembering();
        let (mut message, mut memory) = (remembering.beginning(), Vec::new());
        if let Some((before, known)) = before {
            remembering.message(before, known, &mut message);
        }
        remembering.remember(&message, end, &mut memory);
        memory
    }

    fn holds_after(&self, formula: &Bound, end: &[u64], memory: &[u64]) -> bool {
        formula.holds_in(&self.remembering().at(end, memory)).unwrap_or(false)
    }
}

impl SystemView for RememberingView<'_, '_> {
    fn graph(&self) -> &Graph {
        &self.graph
    }

    fn system(&self) -> &System {
        self.base.system()
    }

    fn holds(&self, formula: &Bound, state: &[u64]) -> bool {
        self.holds_after(formula, self.scan_state(state), &state[1..])
    }

    fn scans(&self) -> Option<&dyn ScanStates> {
        Some(self)
    }

    fn replayed(
        &self,
        states: &[&[u64]],
        loop_start: Option<usize>,
        shows: &dyn Fn(usize, Holds<'_>) -> Result<(), Disagreement>,
    ) -> Result<Trace, Disagreement> {
        let scans: Vec<&[u64]> = states.iter().map(|state| self.scan_state(state)).collect();
        let trace = scan_trace(&self.base.space, &scans, loop_start, None);
        let mut knot = None;
        replay_scans(self.system(), &trace, |position, recalled| {
            self.base.check_assumptions(recalled)?;
            // The loop has to close in the memory, too.
            let known: Vec<i128> = self.history.pasts().map(|past| recalled.past(past)).collect();
            if position == states.len() {
                return match knot.take() == Some(known) {
                    true => Ok(()),
                    false => Err(Disagreement("the lasso does not close in what is remembered".to_owned())),
                };
            }
            let claimed = states[position][1..].iter().map(|&word| remembered(word));
            if !claimed.eq(known.iter().copied()) {
                return Err(Disagreement("the search remembers another past than the replay".to_owned()));
            }
            if Some(position) == loop_start {
                knot = Some(known);
            }
            shows(position, &|formula| recalled.holds(formula))
        })?;
        Ok(Trace::Scans(trace))
    }
}
