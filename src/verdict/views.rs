//! What the two views have in common for a check: states, what holds in them, and traces to them.

use super::{Trace, Witness};
use crate::explore::{Graph, Markings, ScanSpace};
use crate::logic::{Assumption, Bound, Dag, Evidence, MarkingValuation, Node, ScanValuation};
use crate::translate::System;
use crate::verdict::Note;
use crate::witness::{Disagreement, Holds, Recalled, firing_trace, replay_firings, replay_scans, scan_trace};

/// A view of a system.
pub trait SystemView: Sync {
    /// Its states and steps.
    fn graph(&self) -> &Graph;
    /// The system.
    fn system(&self) -> &System;
    /// Whether a formula about one state holds in a state.
    fn holds(&self, formula: &Bound, state: &[u64]) -> bool;
    /// Its states as ends of scans, if they are.
    fn scans(&self) -> Option<&dyn ScanStates> {
        None
    }
    /// The trace along some states, replayed; `shows` is asked at each of them whether the replay shows what it should.
    fn replayed(
        &self,
        states: &[&[u64]],
        loop_start: Option<usize>,
        shows: &dyn Fn(usize, Holds<'_>) -> Result<(), Disagreement>,
    ) -> Result<Trace, Disagreement>;
}

/// A view whose states are ends of scans, each with a memory of the scans before.
pub trait ScanStates: SystemView {
    /// The scan view itself.
    fn base(&self) -> &ScanView<'_>;
    /// The end of a scan as the space packs it, and the memory, of a state.
    fn parts<'a>(&'a self, state: &'a [u64]) -> (&'a [u64], &'a [u64]);
    /// The memory at the end of a scan that comes after another one with its memory, or is the first one.
    fn remember(&self, before: Option<(&[u64], &[u64])>, end: &[u64]) -> Vec<u64>;
    /// Whether a formula about one state holds at the end of a scan, which need not be a state of the graph.
    fn holds_after(&self, formula: &Bound, end: &[u64], memory: &[u64]) -> bool;
}

/// The scan view.
pub struct ScanView<'s> {
    pub space: ScanSpace<'s>,
    pub graph: Graph,
    pub assumptions: &'s [Assumption],
}

impl SystemView for ScanView<'_> {
    fn graph(&self) -> &Graph {
        &self.graph
    }

    fn system(&self) -> &System {
        self.space.system()
    }

    fn holds(&self, formula: &Bound, state: &[u64]) -> bool {
        formula.holds_in(&ScanValuation(&self.space, state)).unwrap_or(false)
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
        let trace = scan_trace(&self.space, states, loop_start, None);
        replay_scans(self.system(), &trace, |position, recalled| {
            self.check_assumptions(recalled)?;
            shows(position, &|formula| recalled.holds(formula))
        })?;
        Ok(Trace::Scans(trace))
    }
}

impl ScanStates for ScanView<'_> {
    fn base(&self) -> &ScanView<'_> {
        self
    }

    fn parts<'a>(&'a self, state: &'a [u64]) -> (&'a [u64], &'a [u64]) {
        (state, &[])
    }

    fn remember(&self, _: Option<(&[u64], &[u64])>, _: &[u64]) -> Vec<u64> {
        Vec::new()
    }

    fn holds_after(&self, formula: &Bound, end: &[u64], _: &[u64]) -> bool {
        self.holds(formula, end)
    }
}

impl ScanView<'_> {
    /// What is assumed must be so in the scan that has just ended.
    pub fn check_assumptions(&self, recalled: &Recalled) -> Result<(), Disagreement> {
        match self.assumptions.iter().find(|assumption| recalled.holds(&assumption.formula) != Some(true)) {
            Some(broken) => Err(Disagreement(format!("the assumption `{}` does not hold in the trace", broken.text))),
            None => Ok(()),
        }
    }
}

/// The transition view.
pub struct TransitionView<'s> {
    pub markings: Markings<'s>,
    pub system: &'s System,
}

impl SystemView for TransitionView<'_> {
    fn graph(&self) -> &Graph {
        self.markings.graph()
    }

    fn system(&self) -> &System {
        self.system
    }

    fn holds(&self, formula: &Bound, state: &[u64]) -> bool {
        formula.holds_in(&MarkingValuation(&self.markings, state)).unwrap_or(false)
    }

    fn replayed(
        &self,
        states: &[&[u64]],
        loop_start: Option<usize>,
        shows: &dyn Fn(usize, Holds<'_>) -> Result<(), Disagreement>,
    ) -> Result<Trace, Disagreement> {
        let trace = firing_trace(&self.markings, states, loop_start);
        if trace.firings.len() + 1 != states.len() + usize::from(loop_start.is_some()) {
            return Err(Disagreement("no transition leads from one state of the trace to the next".to_owned()));
        }
        replay_firings(self.system, &trace, |position, replay| shows(position, &|formula| replay.holds(formula)))?;
        Ok(Trace::Firings(trace))
    }
}

/// The run that evidence describes, replayed, with everything it claims about single states checked on the net.
pub fn witness(view: &dyn SystemView, graph: &Graph, dag: &Dag, evidence: &Evidence) -> Result<Witness, Disagreement> {
    let states: Vec<&[u64]> = evidence.states.iter().map(|&state| graph.state(state)).collect();
    let trace = view.replayed(&states, evidence.loop_start, &|position, holds| {
        for claim in evidence.claims.iter().filter(|claim| claim.position == position) {
            let Node::State { formula, negated } = dag.node(claim.node) else { continue };
            if holds(formula) != Some(!negated) {
                let sentence = dag.sentence(claim.node, view.system());
                return Err(Disagreement(format!("the search claims that {sentence}, the replay does not show it")));
            }
        }
        Ok(())
    })?;
    Ok(Witness { trace, notes: notes(view.system(), dag, evidence) })
}

/// The claims of evidence as notes; a claim that is made of state after state becomes one note.
fn notes(system: &System, dag: &Dag, evidence: &Evidence) -> Vec<Note> {
    let mut notes: Vec<Note> = Vec::new();
    for claim in evidence.claims.iter().filter(|claim| !dag.is_constant(claim.node, true)) {
        let text = dag.sentence(claim.node, system);
        let earlier = notes.iter_mut().find(|note| note.text == text && note.last + 1 >= claim.position);
        match earlier {
            Some(note) => note.last = note.last.max(claim.position),
            None => notes.push(Note { first: claim.position, last: claim.position, text }),
        }
    }
    notes
}
