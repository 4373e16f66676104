//! A system and requirements to a report: one exploration, then every requirement on its graph.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::assumptions::assumptions;
use super::coverage::coverage;
use super::failing::what_is_missing;
use super::fairness::Fair;
use super::independence::{Independence, independence};
use super::news::{InOrder, Tell};
use super::premises::{Occurrence, occurrence};
use super::remarks::remarks;
use super::remembering::RememberingView;
use super::views::{ScanView, SystemView, TransitionView, witness};
use super::why::{Broken, why};
use super::{
    Answer, Exploration, Outcome, Report, Verdict, Witness, admitted, asserted, every_line, hazards, scan_ends,
};
use crate::explore::{Admission, Budget, Graph, Markings, Progress, ScanSpace, explore, never_executed, watched};
use crate::logic::{
    Assertion, Assumed, Assumption, Bound, Dag, Demand, Evidence, FairnessAssumption, History, Labels, Node, NodeId,
    Quantifier, Requirement, View, evidence, label, label_until,
};
use crate::translate::System;
use crate::witness::Disagreement;
use petril_lang::flat::Tolerated;

/// How to check.
#[derive(Clone, Debug)]
pub struct Options {
    /// What a state is.
    pub view: View,
    /// Which runs count: those that meet all of these, which must have been bound for the system and the view.
    pub fairness: Vec<FairnessAssumption>,
    /// How far the exploration may go.
    pub budget: Budget,
    /// The hazards that are no errors. In the scan view nothing is known after the others.
    pub tolerated: Tolerated,
    /// What is assumed of the inputs of each scan, in the scan view.
    pub assumptions: Vec<Assumption>,
    /// What is asserted at lines of the program.
    pub assertions: Vec<Assertion>,
}

impl Default for Options {
    /// The scan view, no hazard tolerated, nothing assumed, and all runs.
    fn default() -> Self {
        let (budget, tolerated) = (Budget::default(), Tolerated::default());
        let (assumptions, assertions, fairness) = (Vec::new(), Vec::new(), Vec::new());
        Self { view: View::Scan, fairness, budget, tolerated, assumptions, assertions }
    }
}

/// Explores a system and judges the requirements, which must have been bound for the view. `watch` can end the exploration;
/// what can be decided on a part of the states is decided then.
#[must_use]
pub fn check(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> Report {
    check_aloud(system, requirements, options, watch, None)
}

/// As [`check()`]; `tell` hears of what was explored and of each answer as soon as all before it are known.
#[must_use]
pub fn check_aloud(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
    tell: Option<Tell<'_>>,
) -> Report {
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

/// Every formula that is asked about.
pub(super) fn asked<'r>(
    requirements: &'r [(Requirement, Demand)],
    options: &'r Options,
) -> impl Iterator<Item = &'r Bound> {
    let required = requirements.iter().filter_map(|(_, demand)| demand.formula());
    required.chain(options.assertions.iter().map(|assertion| &assertion.formula))
}

/// A graph, if every reachable state and step is in it.
fn whole(graph: &Graph) -> Option<&Graph> {
    (graph.is_complete() && !graph.is_empty()).then_some(graph)
}

/// The figures of a search that is over.
fn done(graph: &Graph) -> Progress {
    let states = graph.len() as u64;
    Progress { states, expanded: states, depth: graph.depth(), bytes: graph.bytes() }
}

/// The answers to requirements with these outcomes.
pub(super) fn answers(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    outcomes: Vec<Outcome>,
) -> Vec<Answer> {
    requirements.iter().zip(outcomes).map(|(asked, outcome)| answer(system, asked, options, outcome)).collect()
}

/// The answer to a requirement with this outcome.
pub(super) fn answer(
    system: &System,
    (requirement, demand): &(Requirement, Demand),
    options: &Options,
    outcome: Outcome,
) -> Answer {
    let formula = demand.formula().filter(|_| outcome.verdict() == Verdict::Holds);
    let independent = formula.and_then(|formula| independence(formula, system, &options.assumptions));
    // Which runs count may depend on the program.
    let certain = |it: &Independence| options.fairness.is_empty() || *it == Independence::OfEverything;
    let variables = demand.formula().map(|formula| formula.mentions().variables).unwrap_or_default();
    let variables = variables.into_iter().collect();
    let remark = requirement.remark(options.view);
    Answer { independent: independent.filter(certain), variables, remark, ..Answer::to(requirement, outcome) }
}

/// The outcomes of requirements on scans, and what no run goes through that counts, in words. Requirements that know the same of the
/// past are judged together, on one graph.
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
        // What no run goes through is told above the answers.
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

/// An outcome that nobody waits for any more. Its reason is added where it is known.
pub(super) const STOPPED: Outcome = Outcome::Unknown(String::new());

/// Tells an answer that is final. One that was stopped gets its reason later.
fn tell(told: &InOrder<'_>, position: usize, outcome: &Outcome, answer: impl FnOnce() -> Answer) {
    if !matches!(outcome, Outcome::Unknown(reason) if reason.is_empty()) {
        told.put(position, answer);
    }
}

/// Outcomes with the reason why those were stopped that have none.
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
    // What must be so whenever control comes somewhere, and the checks, are about all runs.
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

/// A report without answers.
fn report(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    graph: &Graph,
    left_out: Option<String>,
) -> Report {
    // The first scan is a step too in the scan view, not in the transition view.
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

/// Judges formulas on a graph.
#[derive(Clone, Copy)]
pub(super) struct Judge<'a> {
    pub view: &'a dyn SystemView,
    pub graph: &'a Graph,
    /// The runs that count, if not all do.
    pub fair: Option<&'a Fair<'a>>,
    /// What following a formula along the paths may use.
    pub budget: Budget,
    /// Whether nobody waits for outcomes any more.
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
        match is_existential(dag, *yes).then(|| self.shown(&labelled, *yes)).flatten() {
            Some(Err(disagreement)) => disagreed(&disagreement.to_string()),
            Some(Ok((witness, _))) => self.holds(formula, Some(witness)),
            None => self.holds(formula, None),
        }
    }

    /// The states that satisfy a formula, and its negation; nothing if nobody waits for them.
    pub(super) fn labelled<'f>(&self, formula: &'f Bound) -> Option<Labelled<'f>> {
        let mut dag = Dag::default();
        let (yes, no) = (dag.add(formula, false), dag.add(formula, true));
        let holds = |formula: &Bound, state: u32| self.view.holds(formula, self.graph.state(state));
        let labels = label_until(self.graph, &dag, &holds, self.fair.map(|fair| &fair.paths), self.stopping)?;
        Some(Labelled { formula, dag, yes, no, labels })
    }

    /// A run from an initial state in which a node holds, and a run that counts begins, if there is one.
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

    /// That the formula is false in an initial state, if that is known.
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

    /// That a formula holds, and whether its premises occur.
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

    /// Whether a run that counts surely begins in a state.
    pub(super) fn counts(&self, state: u32) -> bool {
        self.fair.is_none_or(|fair| fair.paths.surely().contains(state as usize))
    }

    /// Why a requirement that no known run breaks cannot be said to hold, if so; `is_true` says that it is true of all initial states
    /// that are known. It holds only if each initial state is known, and a run that counts surely begins there: what holds only
    /// because no run counts is no answer.
    pub(super) fn undecided(&self, is_true: bool) -> Option<String> {
        let Self { graph, fair, .. } = *self;
        if let Some(vain) = fair.and_then(|fair| fair.vain.as_ref()) {
            return Some(vain.clone());
        }
        let begins = graph.knows_initial() && graph.initial().iter().all(|&state| self.counts(state));
        (!(is_true && begins)).then(|| what_is_missing(graph))
    }

    /// Whether a formula holds in no state of a run that counts.
    pub(super) fn holds_nowhere(&self, formula: &Bound) -> bool {
        let mut dag = Dag::default();
        let node = dag.add(formula, false);
        let holds = |formula: &Bound, state: u32| self.view.holds(formula, self.graph.state(state));
        let paths = self.fair.map(|fair| &fair.paths);
        let labels = label(self.graph, &dag, &holds, paths);
        paths.map_or_else(|| labels.of(node).is_clear(), |paths| labels.of(node).is_disjoint(paths.surely()))
    }
}

/// A formula, its negation, and the states that satisfy each of their parts.
pub(super) struct Labelled<'f> {
    pub formula: &'f Bound,
    pub dag: Dag,
    pub yes: NodeId,
    pub no: NodeId,
    pub labels: Labels,
}

/// Whether a node says that something is possible, so that a path shows it.
pub fn is_existential(dag: &Dag, node: NodeId) -> bool {
    match *dag.node(node) {
        Node::State { .. } => false,
        Node::And(f, g) | Node::Or(f, g) => is_existential(dag, f) || is_existential(dag, g),
        Node::Next(quantifier, _) | Node::Until(quantifier, ..) | Node::WeakUntil(quantifier, ..) => {
            quantifier == Quantifier::Some
        }
    }
}

/// The answer where the replay shows another thing than the search.
pub fn disagreed(what: &str) -> Outcome {
    Outcome::Unknown(format!("the replay refutes the search, which is an error in Petril; please report it: {what}"))
}
