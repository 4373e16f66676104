//! Verdicts on possibility: some run from power-on satisfies the formula.

use super::Outcome;
use super::failing::what_is_missing;
use super::judge::{Judge, Labelled, STOPPED};
use petril_logic::Bound;

impl Judge<'_> {
    /// Decides whether an existential formula is true in some initial state, with a run from there as witness. Violated
    /// if it is false in all initial states.
    pub(super) fn outcome_of_possibility(&self, formula: &Bound) -> Outcome {
        let Self { graph, .. } = *self;
        let Some(labelled) = self.labelled(formula) else { return STOPPED };
        match self.shown(&labelled, labelled.yes) {
            Some(Ok((witness, _))) => return self.holds(formula, Some(witness)),
            Some(Err(disagreement)) => return Outcome::refuted(&disagreement.to_string()),
            None => {}
        }
        let is_false = graph.initial().iter().all(|&state| labelled.labels.of(labelled.no).contains(state as usize));
        if let Some(reason) = self.undecided(is_false) {
            return Outcome::Unknown(reason);
        }
        // An impossibility has no run of its own, so any run stands in.
        self.broken(&labelled).unwrap_or_else(|| Outcome::Unknown(what_is_missing(graph)))
    }

    /// Sentence saying that an existential formula, false in some initial state, is true in another one.
    pub(super) fn elsewhere(&self, labelled: &Labelled<'_>) -> Option<String> {
        let Labelled { formula, dag, yes, labels, .. } = labelled;
        let is_true = |&state: &u32| self.counts(state) && labels.of(*yes).contains(state as usize);
        if !dag.is_existential(*yes) || !self.graph.initial().iter().any(is_true) {
            return None;
        }
        let system = self.view.system();
        let mut sentence = format!(
            "After other first scans `{}` is true, but a requirement must be true after every first scan",
            formula.text(system)
        );
        if let Some(goal) = formula.possibility() {
            let goal = goal.text(system);
            sentence += &format!("; `reachability({goal})` asks whether some run from power-on comes there");
        }
        Some(sentence)
    }
}
