//! Model checking of a system: one exploration, then every requirement on its state graph.

use rayon::prelude::*;

use super::coverage::coverage;
use super::fairness::Fair;
use super::independence::{Independence, independence};
use super::judge::{Judge, STOPPED, whole};
use super::news::{InOrder, Tell};
use super::options::Options;
use super::refused::refused;
use super::remarks::remarks;
use super::remembering::RememberingView;
use super::views::{ScanView, SystemView, TransitionView};
use super::{Answer, Outcome, Report, Verdict, admitted, asserted, every_line, hazards, scan_ends};
use crate::requirement::{Assumed, Demand};
use crate::scans::{Admission, ScanSpace, never_executed};
use crate::translate::System;
use petril_logic::{Bound, FairnessAssumption, History, Requirement, View};
use petril_net::Markings;
use petril_search::{Budget, Graph, Progress, explore, watched};

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
        ..options.report(system, requirements, graph, left_out)
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
            told.begin(|| options.report(view.system(), requirements, &view.graph, left_out.clone()));
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
    told.begin(|| options.report(system, requirements, graph, left_out.clone()));
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
    Report { answers, checks, ..options.report(system, requirements, graph, left_out) }
}
