//! Outcomes of formulas on the graph of a view: violated with a run, holds with its vacuity, or unknown.

use std::sync::atomic::{AtomicBool, Ordering};

use super::failing::what_is_missing;
use super::fairness::Fair;
use super::premises::{Occurrence, occurrence};
use super::views::{SystemView, witness};
use super::why::{Broken, why};
use super::{Outcome, Witness};
use crate::witness::Disagreement;
use petril_logic::{Bound, Dag, Evidence, Labels, NodeId, evidence, label, label_until};
use petril_search::{Budget, Graph};

/// The graph, if it is complete and not empty.
pub(super) fn whole(graph: &Graph) -> Option<&Graph> {
    (graph.is_complete() && !graph.is_empty()).then_some(graph)
}

/// Outcome of an interrupted question. The reason is added by [`explained`].
pub(super) const STOPPED: Outcome = Outcome::Unknown(String::new());

/// Decides formulas on a state graph.
#[derive(Clone, Copy)]
pub(super) struct Judge<'a> {
    pub view: &'a dyn SystemView,
    pub graph: &'a Graph,
    /// Fairness assumptions, if any.
    pub fair: Option<&'a Fair<'a>>,
    /// Limits for the product with an LTL automaton.
    pub budget: Budget,
    /// Whether the search is to stop.
    pub stopping: &'a AtomicBool,
}

impl Judge<'_> {
    fn is_stopped(&self) -> bool {
        self.stopping.load(Ordering::Relaxed)
    }

    pub(super) fn outcome(&self, formula: &Bound) -> Outcome {
        if self.is_stopped() {
            return STOPPED;
        }
        if let Bound::Ltl(path) = formula {
            return self.outcome_on_paths(path);
        }
        let Self { graph, .. } = *self;
        let Some(labelled) = self.labelled(formula) else { return STOPPED };
        match self.broken(&labelled) {
            Some(Outcome::Violated(witness, why)) => {
                let why = why.map(|mut why| {
                    why.wanted.extend(self.elsewhere(&labelled));
                    why
                });
                return Outcome::Violated(witness, why);
            }
            Some(disagreed) => return disagreed,
            None => {}
        }
        let Labelled { dag, labels, yes, .. } = &labelled;
        let is_true = graph.initial().iter().all(|&state| labels.of(*yes).contains(state as usize));
        if let Some(reason) = self.undecided(is_true) {
            return Outcome::Unknown(reason);
        }
        match dag.is_existential(*yes).then(|| self.shown(&labelled, *yes)).flatten() {
            Some(Err(disagreement)) => Outcome::refuted(&disagreement.to_string()),
            Some(Ok((witness, _))) => self.holds(formula, Some(witness)),
            None => self.holds(formula, None),
        }
    }

    /// Labels the states with the formula and its negation; `None` if interrupted.
    pub(super) fn labelled<'f>(&self, formula: &'f Bound) -> Option<Labelled<'f>> {
        let mut dag = Dag::default();
        let (yes, no) = (dag.add(formula, false), dag.add(formula, true));
        let holds = |formula: &Bound, state: u32| self.view.holds(formula, self.graph.state(state));
        let labels = label_until(self.graph, &dag, &holds, self.fair.map(|fair| &fair.paths), self.stopping)?;
        Some(Labelled { formula, dag, yes, no, labels })
    }

    /// Evidence: a fair run from an initial state that satisfies the node, replayed, if there is one.
    pub(super) fn shown(
        &self,
        Labelled { dag, labels, .. }: &Labelled<'_>,
        node: NodeId,
    ) -> Option<Result<(Witness, Evidence), Disagreement>> {
        let Self { view, graph, fair, .. } = *self;
        let (paths, assumed) = (fair.map(|fair| &fair.paths), fair.map_or(&[][..], |fair| fair.assumptions));
        let beginnings: Vec<u32> = graph.initial().iter().copied().filter(|&state| self.counts(state)).collect();
        let evidence = evidence(graph, dag, labels, paths, node, &beginnings)?;
        Some(witness(view, dag, &evidence, assumed, &|_, _| ()).map(|witness| (witness, evidence)))
    }

    /// The violation, if a known initial state violates the formula.
    pub(super) fn broken(&self, labelled: &Labelled<'_>) -> Option<Outcome> {
        let Self { view, graph, .. } = *self;
        Some(match self.shown(labelled, labelled.no)? {
            Ok((witness, evidence)) => {
                let Labelled { formula, dag, labels, no: negation, .. } = labelled;
                let broken = Broken { view, graph, formula, dag, negation: *negation, labels, evidence: &evidence };
                let why = why(broken, &witness);
                Outcome::Violated(witness, why)
            }
            Err(disagreement) => Outcome::refuted(&disagreement.to_string()),
        })
    }

    /// The outcome "holds", with vacuity check and example.
    pub(super) fn holds(&self, formula: &Bound, witness: Option<Witness>) -> Outcome {
        if self.is_stopped() {
            return STOPPED;
        }
        let paths = self.fair.map(|fair| &fair.paths);
        let occurrence = whole(self.graph).map(|graph| occurrence(self.view, graph, paths, formula)).transpose();
        match occurrence {
            Ok(occurrence) => {
                let Occurrence { vacuous, example } = occurrence.unwrap_or_default();
                Outcome::Holds { vacuous, witness, example }
            }
            Err(disagreement) => Outcome::refuted(&disagreement.to_string()),
        }
    }

    /// Whether a fair run surely begins in a state.
    pub(super) fn counts(&self, state: u32) -> bool {
        self.fair.is_none_or(|fair| fair.paths.surely().contains(state as usize))
    }

    /// Reason why a requirement without a known counterexample cannot be said to hold, if so; `is_true` says that all
    /// known initial states satisfy it. A requirement holds only if every initial state is known and a fair run surely
    /// begins there: truth for lack of fair runs is not an answer.
    pub(super) fn undecided(&self, is_true: bool) -> Option<String> {
        let Self { graph, fair, .. } = *self;
        if let Some(vain) = fair.and_then(|fair| fair.vain.as_ref()) {
            return Some(vain.clone());
        }
        let begins = graph.knows_initial() && graph.initial().iter().all(|&state| self.counts(state));
        (!(is_true && begins)).then(|| what_is_missing(graph))
    }

    /// Whether no state of a fair run satisfies a formula.
    pub(super) fn holds_nowhere(&self, formula: &Bound) -> bool {
        let mut dag = Dag::default();
        let node = dag.add(formula, false);
        let holds = |formula: &Bound, state: u32| self.view.holds(formula, self.graph.state(state));
        let paths = self.fair.map(|fair| &fair.paths);
        let labels = label(self.graph, &dag, &holds, paths);
        paths.map_or_else(|| labels.of(node).is_clear(), |paths| labels.of(node).is_disjoint(paths.surely()))
    }
}

/// A formula and its negation with the states that satisfy each subformula.
pub(super) struct Labelled<'f> {
    pub formula: &'f Bound,
    pub dag: Dag,
    pub yes: NodeId,
    pub no: NodeId,
    pub labels: Labels,
}
