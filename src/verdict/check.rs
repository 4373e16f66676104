//! A system and requirements to a report: one exploration, then every requirement on its graph.

use fixedbitset::FixedBitSet;
use rayon::prelude::*;

use super::assumptions::assumptions;
use super::coverage::coverage;
use super::failing::what_is_missing;
use super::independence::independence;
use super::premises::{Occurrence, occurrence};
use super::remarks::remarks;
use super::remembering::RememberingView;
use super::views::{ScanView, SystemView, TransitionView, witness};
use super::why::{Broken, why};
use super::{Answer, Exploration, Outcome, Report, Verdict, admitted, asserted, every_line, hazards, scan_ends};
use crate::explore::{Admission, Budget, Graph, Markings, Progress, ScanSpace, explore, never_executed};
use crate::flat::Tolerated;
use crate::logic::{
    Assertion, Assumed, Assumption, Bound, Dag, Demand, History, Node, NodeId, Quantifier, Requirement, View, evidence,
    label,
};
use crate::translate::{PlaceRole, System};

/// How to check.
#[derive(Clone, Debug)]
pub struct Options {
    /// What a state is.
    pub view: View,
    /// In the transition view, leave out runs in which the plant moves for ever and the PLC never scans again.
    pub fair: bool,
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
    /// The scan view, no hazard tolerated, and nothing assumed.
    fn default() -> Self {
        let (budget, tolerated) = (Budget::default(), Tolerated::default());
        Self { view: View::Scan, fair: false, budget, tolerated, assumptions: Vec::new(), assertions: Vec::new() }
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
    match options.view {
        View::Scan => check_scans(system, requirements, options, watch),
        View::Transition => check_markings(system, requirements, options, watch),
    }
}

fn check_scans(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> Report {
    let Options { assumptions, assertions, .. } = options;
    let assumed = Assumed { assumptions, assertions };
    let is_needed = !assumptions.is_empty() || !assertions.is_empty();
    let admission = is_needed.then_some(&assumed as &dyn Admission);
    let space = ScanSpace::assuming(system, options.tolerated, admission);
    let graph = explore(&space, options.budget, watch);
    let view = ScanView { space, graph, assumptions: &options.assumptions };
    let outcomes = outcomes(&view, requirements, options, watch);
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
        ..report(system, requirements, options, graph)
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
    let answer = |((requirement, demand), outcome): (&(Requirement, Demand), Outcome)| {
        let formula = demand.formula().filter(|_| outcome.verdict() == Verdict::Holds);
        let independent = formula.and_then(|formula| independence(formula, system, &options.assumptions));
        Answer { independent, ..Answer::to(requirement, outcome) }
    };
    requirements.iter().zip(outcomes).map(answer).collect()
}

/// The outcomes of requirements on scans. Those that know the same of the past are judged together, on one graph.
fn outcomes(
    view: &ScanView<'_>,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> Vec<Outcome> {
    let mut groups: Vec<(History, Vec<usize>)> = Vec::new();
    for (position, (_, demand)) in requirements.iter().enumerate() {
        let history = History::of(demand.formula());
        match groups.iter_mut().find(|(known, _)| *known == history) {
            Some((_, members)) => members.push(position),
            None => groups.push((history, vec![position])),
        }
    }
    let mut outcomes = vec![Outcome::holds(); requirements.len()];
    for (history, members) in groups {
        let remembering;
        let judge = if history.is_empty() {
            Judge { view, graph: &view.graph, fair: None }
        } else {
            let bytes = options.budget.bytes.saturating_sub(view.graph.bytes());
            remembering = RememberingView::new(view, history, Budget { bytes, ..options.budget }, watch);
            Judge { view: &remembering, graph: remembering.graph(), fair: None }
        };
        let judged = members.par_iter().map(|&position| match &requirements[position].1 {
            Demand::Formula(formula) => judge.outcome(formula),
            Demand::EveryLine => every_line::outcome(view),
        });
        let judged: Vec<Outcome> = judged.collect();
        members.into_iter().zip(judged).for_each(|(position, outcome)| outcomes[position] = outcome);
    }
    outcomes
}

fn check_markings(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> Report {
    let markings = Markings::explored(&system.net, options.budget, watch);
    let view = TransitionView { markings, system };
    let graph = view.graph();
    let fair = options.fair.then(|| scanning(&view, graph));
    let judge = Judge { view: &view, graph, fair: fair.as_ref() };
    let outcomes = requirements.par_iter().map(|(_, demand)| match demand {
        Demand::Formula(formula) => judge.outcome(formula),
        Demand::EveryLine => Outcome::Unknown("this is checked in the scan view".to_owned()),
    });
    let asserted = options.assertions.iter().map(|assertion| {
        let outcome = judge.outcome(&assertion.as_formula(system));
        asserted::answer(assertion, outcome)
    });
    let answers = answers(system, requirements, options, outcomes.collect()).into_iter().chain(asserted).collect();
    let unfair = Judge { fair: None, ..judge };
    let ends = std::iter::once(scan_ends::answer(unfair.outcome(&scan_ends::formula(system))));
    let hazards = hazards::checked(&system.program, options.tolerated)
        .map(|hazard| hazards::answer(hazard, unfair.outcome(&hazards::formula(system, hazard))));
    let checks = ends.chain(hazards).collect();
    Report { answers, checks, ..report(system, requirements, options, graph) }
}

/// A report without answers.
fn report(system: &System, requirements: &[(Requirement, Demand)], options: &Options, graph: &Graph) -> Report {
    // The first scan is a step too in the scan view, not in the transition view.
    let depth = graph.depth() + usize::from(options.view == View::Scan && !graph.is_empty());
    let timed = requirements.iter().any(|(requirement, _)| requirement.speaks_of_time());
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
        assumptions: assumptions(system, options, timed),
        answers: Vec::new(),
        checks: Vec::new(),
        remarks: Vec::new(),
        coverage: None,
    }
}

/// The states in which the PLC is not idle. From an idle state `block` is always enabled, so leaving out the paths on which it
/// stays enabled and never fires means to ask for these states again and again.
fn scanning(view: &dyn SystemView, graph: &Graph) -> FixedBitSet {
    let idle = Bound::Marked(view.system().place(PlaceRole::Idle));
    let mut states = FixedBitSet::with_capacity(graph.len());
    states.extend(graph.ids().filter(|&id| !view.holds(&idle, graph.state(id))).map(|id| id as usize));
    states
}

/// Judges formulas on a graph.
#[derive(Clone, Copy)]
struct Judge<'a> {
    view: &'a dyn SystemView,
    graph: &'a Graph,
    fair: Option<&'a FixedBitSet>,
}

impl Judge<'_> {
    fn outcome(&self, formula: &Bound) -> Outcome {
        let Self { view, graph, fair } = *self;
        let mut dag = Dag::default();
        let (yes, no) = (dag.add(formula, false), dag.add(formula, true));
        let holds = |formula: &Bound, state: u32| view.holds(formula, graph.state(state));
        let labels = label(graph, &dag, &holds, fair);
        let evidence = |node: NodeId| evidence(graph, &dag, &labels, fair, node, graph.initial());
        let shown = |node: NodeId| Some(witness(view, graph, &dag, &evidence(node)?));
        let broken = evidence(no).map(|evidence| (witness(view, graph, &dag, &evidence), evidence));
        match broken {
            Some((Ok(witness), evidence)) => {
                let (dag, labels, evidence) = (&dag, &labels, &evidence);
                let why = why(Broken { view, graph, formula, dag, negation: no, labels, evidence }, &witness);
                return Outcome::Violated(witness, why);
            }
            Some((Err(disagreement), _)) => return disagreed(&disagreement.to_string()),
            None => {}
        }
        let everywhere = graph.initial().iter().all(|&state| labels.of(yes).contains(state as usize));
        if !(everywhere && graph.knows_initial()) {
            return Outcome::Unknown(what_is_missing(graph));
        }
        let witness = match is_existential(&dag, yes).then(|| shown(yes)).flatten() {
            Some(Ok(witness)) => Some(witness),
            Some(Err(disagreement)) => return disagreed(&disagreement.to_string()),
            None => None,
        };
        let occurrence = whole(graph).map(|graph| occurrence(view, graph, fair, formula)).transpose();
        match occurrence {
            Ok(occurrence) => {
                let Occurrence { vacuous, example } = occurrence.unwrap_or_default();
                Outcome::Holds { vacuous, witness, example }
            }
            Err(disagreement) => disagreed(&disagreement.to_string()),
        }
    }
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
