//! Model checking of a system: one exploration, then every requirement on its state graph.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::assumptions::assumptions;
use super::coverage::coverage;
use super::failing::what_is_missing;
use super::fairness::Fair;
use super::independence::{Independence, independence};
use super::news::{InOrder, Tell};
use super::premises::{Occurrence, occurrence};
use super::refused::refused;
use super::remarks::remarks;
use super::remembering::RememberingView;
use super::views::{ScanView, SystemView, TransitionView, witness};
use super::why::{Broken, why};
use super::{
    Answer, Exploration, Outcome, Report, Verdict, Witness, admitted, asserted, every_line, hazards, scan_ends,
};
use crate::requirement::{Assertion, Assumed, Assumption, Demand};
use crate::scans::{Admission, ScanSpace, never_executed};
use crate::translate::System;
use crate::witness::Disagreement;
use petril_lang::flat::Tolerated;
use petril_logic::{
    Bound, Dag, Evidence, FairnessAssumption, History, Labels, NodeId, Requirement, View, evidence, label, label_until,
};
use petril_net::Markings;
use petril_search::{Budget, Graph, Progress, explore, watched};

/// Options of a check.
#[derive(Clone, Debug)]
pub struct Options {
    /// State space: one state per scan, or one per marking.
    pub view: View,
    /// Fairness assumptions, bound for the system and the view; only runs that meet all of them count.
    pub fairness: Vec<FairnessAssumption>,
    /// Limits of the exploration.
    pub budget: Budget,
    /// Hazards that are not errors. In the scan view, other hazards end the run.
    pub tolerated: Tolerated,
    /// Assumptions about the inputs of each scan (scan view only).
    pub assumptions: Vec<Assumption>,
    /// Assertions at lines of the program.
    pub assertions: Vec<Assertion>,
}

impl Default for Options {
    /// Scan view, no hazard tolerated, no assumptions, no fairness.
    fn default() -> Self {
        let (budget, tolerated) = (Budget::default(), Tolerated::default());
        let (assumptions, assertions, fairness) = (Vec::new(), Vec::new(), Vec::new());
        Self { view: View::Scan, fairness, budget, tolerated, assumptions, assertions }
    }
}

/// Explores a system and decides the requirements. `watch` can end the exploration; whatever the explored part decides is
/// then decided. A requirement that was bound for the other view, or for a system with other variables and places, makes
/// the check be refused: all answers are unknown.
#[must_use]
pub fn check(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> Report {
    check_aloud(system, requirements, options, watch, None)
}

/// As [`check()`]; `tell` receives the exploration, and each answer as soon as all before it are known.
#[must_use]
pub fn check_aloud(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
    tell: Option<Tell<'_>>,
) -> Report {
    if let Some(report) = refused(system, requirements, options) {
        return report;
    }
    let told = InOrder::new(tell);
    match options.view {
        View::Scan => check_scans(system, requirements, options, watch, &told),
        View::Transition => check_markings(system, requirements, options, watch, &told),
    }
}

fn check_scans(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
    told: &InOrder<'_>,
) -> Report {
    let Options { assumptions, assertions, .. } = options;
    let assumed = Assumed { assumptions, assertions };
    let is_needed = !assumptions.is_empty() || !assertions.is_empty();
    let admission = is_needed.then_some(&assumed as &dyn Admission);
    let space = ScanSpace::assuming(system, options.tolerated, admission);
    let graph = explore(&space, options.budget, watch);
    let view = ScanView { space, graph, assumptions: &options.assumptions };
    let (outcomes, left_out) = outcomes(&view, requirements, options, watch, told);
    let ScanView { space, graph, .. } = &view;
    let asserted = asserted::answers(&view, &options.assertions, &mut || watch(&done(graph)).is_some());
    let ends = std::iter::once(scan_ends::answer(scan_ends::on_scans(space, graph)));
    let hazards = hazards::checked(&system.program, options.tolerated)
        .map(|hazard| hazards::answer(hazard, hazards::on_scans(space, graph, hazard)));
    let inputs = (!assumptions.is_empty()).then(|| admitted::answer(admitted::outcome(&view)));
    let never = whole(graph).and_then(|graph| never_executed(space, graph, &mut || watch(&done(graph)).is_some()));
    Report {
        answers: answers(system, requirements, options, outcomes).into_iter().chain(asserted).collect(),
        checks: ends.chain(hazards).chain(inputs).collect(),
        remarks: remarks(space, graph, never.as_deref().unwrap_or_default()),
        coverage: Some(coverage(system, asked(requirements, options), never)),
        ..report(system, requirements, options, graph, left_out)
    }
}

/// Formulas of all requirements and assertions.
pub(super) fn asked<'r>(
    requirements: &'r [(Requirement, Demand)],
    options: &'r Options,
) -> impl Iterator<Item = &'r Bound> {
    let required = requirements.iter().filter_map(|(_, demand)| demand.formula());
    required.chain(options.assertions.iter().map(|assertion| &assertion.formula))
}

/// The graph, if it is complete and not empty.
fn whole(graph: &Graph) -> Option<&Graph> {
    (graph.is_complete() && !graph.is_empty()).then_some(graph)
}

/// Progress figures of a finished search.
fn done(graph: &Graph) -> Progress {
    let states = graph.len() as u64;
    Progress { states, expanded: states, depth: graph.depth(), bytes: graph.bytes() }
}

/// Combines requirements with their outcomes.
pub(super) fn answers(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    outcomes: Vec<Outcome>,
) -> Vec<Answer> {
    requirements.iter().zip(outcomes).map(|(asked, outcome)| answer(system, asked, options, outcome)).collect()
}

/// Combines a requirement with its outcome: adds independence and remark.
pub(super) fn answer(
    system: &System,
    (requirement, demand): &(Requirement, Demand),
    options: &Options,
    outcome: Outcome,
) -> Answer {
    let formula = demand.formula().filter(|_| outcome.verdict() == Verdict::Holds);
    let independent = formula.and_then(|formula| independence(formula, system, &options.assumptions));
    // Which runs are fair may depend on the program, so only tautologies are independent then.
    let certain = |it: &Independence| options.fairness.is_empty() || *it == Independence::OfEverything;
    let variables = demand.formula().map(|formula| formula.mentions().variables).unwrap_or_default();
    let variables = variables.into_iter().collect();
    let remark = requirement.remark(options.view);
    Answer { independent: independent.filter(certain), variables, remark, ..Answer::to(requirement, outcome) }
}

/// Outcomes of requirements on scans, and in words the states left out by fairness. Requirements with the same history
/// (past-time terms) are decided together, on one product graph.
fn outcomes(
    view: &ScanView<'_>,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
    told: &InOrder<'_>,
) -> (Vec<Outcome>, Option<String>) {
    let mut groups: Vec<(History, Vec<usize>)> = Vec::new();
    for (position, (_, demand)) in requirements.iter().enumerate() {
        let assumed = options.fairness.iter().flat_map(FairnessAssumption::formulas);
        let history = History::of(demand.formula().into_iter().chain(assumed));
        match groups.iter_mut().find(|(known, _)| *known == history) {
            Some((_, members)) => members.push(position),
            None => groups.push((history, vec![position])),
        }
    }
    let mut outcomes = vec![Outcome::holds(); requirements.len()];
    let (mut left_out, mut rest) = (None, groups.len());
    let progress = done(&view.graph);
    for (history, members) in groups {
        rest -= 1;
        let bytes = options.budget.bytes.saturating_sub(view.graph.bytes());
        let budget = Budget { bytes, ..options.budget };
        let remembering;
        let view_of: &dyn SystemView = if history.is_empty() {
            view
        } else {
            remembering = RememberingView::new(view, history, budget, watch);
            &remembering
        };
        let fair = Fair::on(view_of, &options.fairness);
        left_out = left_out.or_else(|| fair.as_ref().and_then(Fair::left_out));
        // States left out by fairness are reported above the answers.
        if fair.is_none() || left_out.is_some() || rest == 0 {
            told.begin(|| report(view.system(), requirements, options, &view.graph, left_out.clone()));
        }
        let (judged, reason) = watched(watch, &progress, |stopping| {
            let judge = Judge { view: view_of, graph: view_of.graph(), fair: fair.as_ref(), budget, stopping };
            let judged = members.par_iter().map(|&position| {
                let outcome = match &requirements[position].1 {
                    Demand::Formula(formula) => judge.outcome(formula),
                    Demand::Possible(formula) => judge.outcome_of_possibility(formula),
                    Demand::EveryLine => every_line::outcome(view),
                };
                tell(told, position, &outcome, || {
                    answer(view.system(), &requirements[position], options, outcome.clone())
                });
                outcome
            });
            judged.collect()
        });
        let judged = explained(judged, reason, members.len());
        members.into_iter().zip(judged).for_each(|(position, outcome)| outcomes[position] = outcome);
    }
    (outcomes, left_out)
}

/// Outcome of an interrupted question. The reason is added by [`explained`].
pub(super) const STOPPED: Outcome = Outcome::Unknown(String::new());

/// Reports a final answer. An interrupted one gets its reason later.
fn tell(told: &InOrder<'_>, position: usize, outcome: &Outcome, answer: impl FnOnce() -> Answer) {
    if !matches!(outcome, Outcome::Unknown(reason) if reason.is_empty()) {
        told.put(position, answer);
    }
}

/// Fills in the reason of interrupted outcomes.
fn explained(judged: Option<Vec<Outcome>>, reason: Option<String>, count: usize) -> Vec<Outcome> {
    let judged = judged.unwrap_or_else(|| vec![STOPPED; count]);
    let reason = format!("{} while requirements were checked", reason.unwrap_or_else(|| "it was stopped".to_owned()));
    let explain = |outcome| match outcome {
        Outcome::Unknown(none) if none.is_empty() => Outcome::Unknown(reason.clone()),
        outcome => outcome,
    };
    judged.into_iter().map(explain).collect()
}

fn check_markings(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
    told: &InOrder<'_>,
) -> Report {
    let markings = Markings::explored(&system.net, options.budget, watch);
    let view = TransitionView { markings, system };
    let graph = view.graph();
    let fair = Fair::on(&view, &options.fairness);
    let left_out = fair.as_ref().and_then(Fair::left_out);
    told.begin(|| report(system, requirements, options, graph, left_out.clone()));
    // Assertions and built-in checks range over all runs, fair or not.
    let hazards: Vec<_> = hazards::checked(&system.program, options.tolerated).collect();
    let mut unfair: Vec<Bound> = options.assertions.iter().map(|assertion| assertion.as_formula(system)).collect();
    unfair.push(scan_ends::formula(system));
    unfair.extend(hazards.iter().map(|&hazard| hazards::formula(system, hazard)));
    let count = requirements.len() + unfair.len();
    let (judged, reason) = watched(watch, &done(graph), |stopping| {
        let judge = Judge { view: &view, graph, fair: fair.as_ref(), budget: options.budget, stopping };
        let outcomes = requirements.par_iter().enumerate().map(|(position, asked)| {
            let outcome = match &asked.1 {
                Demand::Formula(formula) => judge.outcome(formula),
                Demand::Possible(formula) => judge.outcome_of_possibility(formula),
                Demand::EveryLine => Outcome::Unknown("this is checked in the scan view".to_owned()),
            };
            tell(told, position, &outcome, || answer(system, asked, options, outcome.clone()));
            outcome
        });
        let mut outcomes: Vec<Outcome> = outcomes.collect();
        let of_all_runs = Judge { fair: None, ..judge };
        outcomes.extend(unfair.iter().map(|formula| of_all_runs.outcome(formula)));
        outcomes
    });
    let mut outcomes = explained(judged, reason, count);
    let mut unfair = outcomes.split_off(requirements.len()).into_iter();
    let asserted: Vec<Answer> =
        options.assertions.iter().zip(&mut unfair).map(|(of, outcome)| asserted::answer(of, outcome)).collect();
    let answers = answers(system, requirements, options, outcomes).into_iter().chain(asserted).collect();
    let ends: Vec<Answer> = unfair.next().map(scan_ends::answer).into_iter().collect();
    let hazards = hazards.into_iter().zip(unfair).map(|(hazard, outcome)| hazards::answer(hazard, outcome));
    let checks = ends.into_iter().chain(hazards).collect();
    Report { answers, checks, ..report(system, requirements, options, graph, left_out) }
}

/// Builds a report without answers.
pub(super) fn report(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    graph: &Graph,
    left_out: Option<String>,
) -> Report {
    // Depth counts steps; in the scan view the first scan is a step, too.
    let depth = graph.depth() + usize::from(options.view == View::Scan && !graph.is_empty());
    let timed = requirements.iter().any(|(requirement, _)| requirement.speaks_of_time())
        || options.fairness.iter().any(|assumed| assumed.speaks_of_time);
    Report {
        exploration: Exploration {
            view: options.view,
            states: graph.len(),
            steps: graph.steps(),
            depth,
            complete: graph.is_complete(),
            stop: graph.stop().clone(),
            bytes: graph.bytes(),
            recalled: false,
        },
        assumptions: assumptions(system, options, timed).into_iter().chain(left_out).collect(),
        warnings: Vec::new(),
        answers: Vec::new(),
        checks: Vec::new(),
        remarks: Vec::new(),
        coverage: None,
    }
}

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

    fn outcome(&self, formula: &Bound) -> Outcome {
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
            Some(Err(disagreement)) => disagreed(&disagreement.to_string()),
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
            Err(disagreement) => disagreed(&disagreement.to_string()),
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
            Err(disagreement) => disagreed(&disagreement.to_string()),
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

/// Outcome where replay and search disagree (an error in Petril).
pub fn disagreed(what: &str) -> Outcome {
    Outcome::Unknown(format!("the replay refutes the search, which is an error in Petril; please report it: {what}"))
}
