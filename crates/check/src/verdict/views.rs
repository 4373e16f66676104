//! Common interface of the two views: states, valuation of formulas, and traces.

use std::cell::RefCell;
use std::collections::BTreeMap;

use super::{Trace, Witness};
use crate::requirement::{Assumption, ScanValuation};
use crate::scans::ScanSpace;
use crate::translate::System;
use crate::verdict::Note;
use crate::witness::{Disagreement, Holds, Recalled, firing_trace, replay_firings, replay_scans, scan_trace};
use petril_logic::{Bound, Constraint, Dag, Evidence, FairnessAssumption, Node};
use petril_net::MarkingValuation;
use petril_net::Markings;
use petril_search::Graph;

/// A view of a system.
pub trait SystemView: Sync {
    /// State graph.
    fn graph(&self) -> &Graph;
    /// The system.
    fn system(&self) -> &System;
    /// Whether a state satisfies a state formula.
    fn holds(&self, formula: &Bound, state: &[u64]) -> bool;
    /// The states as ends of scans; `None` in the transition view.
    fn scans(&self) -> Option<&dyn ScanStates> {
        None
    }
    /// Replays the trace along some states; `shows` is called at each of them and checks the claims made there.
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
    /// The two parts of a state: end of scan as the space packs it, and memory.
    fn parts<'a>(&'a self, state: &'a [u64]) -> (&'a [u64], &'a [u64]);
    /// Memory at the end of a scan, from the scan before it with its memory; `None` for the first scan.
    fn remember(&self, before: Option<(&[u64], &[u64])>, end: &[u64]) -> Vec<u64>;
    /// Whether a state formula holds at the end of a scan, which need not be a state of the graph.
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
    /// Checks the assumptions in the scan that has just ended.
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

/// Replays the run described by evidence. All its claims about single states are checked on the net, and a lasso must
/// meet the fairness assumptions. `look` is called at each state, too.
pub fn witness(
    view: &dyn SystemView,
    dag: &Dag,
    evidence: &Evidence,
    assumed: &[FairnessAssumption],
    look: &dyn Fn(usize, Holds<'_>),
) -> Result<Witness, Disagreement> {
    let graph = view.graph();
    let states: Vec<&[u64]> = evidence.states.iter().map(|&state| graph.state(state)).collect();
    let constraints: Vec<&Constraint> = assumed.iter().flat_map(|assumed| &assumed.constraints).collect();
    // For each constraint, whether premise and goal were seen within the loop.
    let seen = RefCell::new(vec![(false, false); constraints.len()]);
    let trace = view.replayed(&states, evidence.loop_start, &|position, holds| {
        // Claims are in the order of the path.
        let from = evidence.claims.partition_point(|claim| claim.position < position);
        for claim in evidence.claims[from..].iter().take_while(|claim| claim.position == position) {
            let Node::State { formula, negated } = dag.node(claim.node) else { continue };
            if holds(formula) != Some(!negated) {
                let sentence = dag.sentence(claim.node, view.system());
                return Err(Disagreement(format!("the search claims that {sentence}, the replay does not show it")));
            }
        }
        look(position, holds);
        if evidence.loop_start.is_some_and(|start| start <= position) {
            for (constraint, (premise, goal)) in constraints.iter().zip(seen.borrow_mut().iter_mut()) {
                *premise |= constraint.premise.as_ref().is_none_or(|premise| holds(premise) != Some(false));
                *goal |= holds(&constraint.goal) == Some(true);
            }
        }
        Ok(())
    })?;
    let seen = seen.into_inner();
    if let Some((broken, _)) = constraints.iter().zip(seen).find(|(_, (premise, goal))| *premise && !goal) {
        return Err(Disagreement(format!("the run does not meet the assumption that {}", broken.words)));
    }
    Ok(Witness { trace, notes: notes(view.system(), dag, evidence) })
}

/// Claims of evidence as notes; a claim about consecutive states becomes one note.
fn notes(system: &System, dag: &Dag, evidence: &Evidence) -> Vec<Note> {
    let mut notes: Vec<Note> = Vec::new();
    // Text of each node, and latest note of each text: claims are in the order of the path.
    let (mut texts, mut latest) = (BTreeMap::new(), BTreeMap::new());
    for claim in evidence.claims.iter().filter(|claim| !dag.is_constant(claim.node, true)) {
        let text: &String = texts.entry(claim.node).or_insert_with(|| dag.sentence(claim.node, system));
        let earlier = latest.get(text).map(|&note: &usize| &mut notes[note]);
        match earlier.filter(|note| note.last + 1 >= claim.position) {
            Some(note) => note.last = note.last.max(claim.position),
            None => {
                latest.insert(text.clone(), notes.len());
                notes.push(Note { first: claim.position, last: claim.position, text: text.clone() });
            }
        }
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::translate::Plant;
    use petril_base::source::Source;
    use petril_lang::flat::flatten;
    use petril_lang::{semantics, syntax};
    use petril_search::{Budget, explore};

    /// A search that is wrong about fairness gets no verdict: the replay sees that the loop does not meet a constraint.
    #[test]
    fn the_replay_holds_a_loop_to_every_constraint() {
        let text = "PROGRAM p VAR_INPUT x : BOOL; END_VAR VAR_OUTPUT q : BOOL; END_VAR\nLD x\nST q\nEND_PROGRAM";
        let (unit, _) = syntax::parse(&Source::new("program", text));
        let Some(program) = semantics::check(&unit, true).0 else { panic!("it is a program") };
        let system = System::new(flatten(&program), Plant::default());
        let space = ScanSpace::new(&system);
        let graph = explore(&space, Budget::default(), &mut |_| None);
        let view = ScanView { space, graph, assumptions: &[] };
        let [x, q] =
            ["x", "q"].map(|name| Bound::Variable(system.program.find(name).unwrap_or_else(|| panic!("{name}"))));
        let with_x =
            view.graph.ids().find(|&id| view.holds(&x, view.graph.state(id))).unwrap_or_else(|| panic!("no x"));
        let evidence = Evidence { states: vec![with_x], loop_start: Some(0), claims: Vec::new() };
        let shown = |premise: Option<&Bound>, goal: Bound| {
            let constraint = Constraint { premise: premise.cloned(), goal, words: "…".to_owned() };
            let assumed =
                [FairnessAssumption { words: "…".to_owned(), constraints: vec![constraint], speaks_of_time: false }];
            witness(&view, &Dag::default(), &evidence, &assumed, &|_, _| ()).map(|_| ()).map_err(|error| error.0)
        };
        let refuted = || Err("the run does not meet the assumption that …".to_owned());
        let not_x = || Bound::Not(Box::new(x.clone()));
        assert_eq!(shown(None, x.clone()), Ok(()));
        assert_eq!(shown(None, not_x()), refuted());
        assert_eq!(shown(Some(&q), not_x()), refuted());
        assert_eq!(shown(Some(&not_x()), not_x()), Ok(()));
    }
}
