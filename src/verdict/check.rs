//! A system and requirements to a report: one exploration, then every requirement on its graph.

use fixedbitset::FixedBitSet;
use rayon::prelude::*;

use super::assumptions::assumptions;
use super::coverage::coverage;
use super::failing::what_is_missing;
use super::independence::independence;
use super::premises::{Occurrence, occurrence};
use super::remarks::remarks;
use super::views::{ScanView, SystemView, TransitionView, witness};
use super::why::{Broken, why};
use super::{Answer, Exploration, Outcome, Report, Verdict, hazards, scan_ends};
use crate::explore::{Budget, Graph, Markings, Progress, ScanSpace, explore, never_executed};
use crate::flat::Tolerated;
use crate::logic::{Bound, Dag, Node, NodeId, Quantifier, Requirement, View, evidence, label};
use crate::translate::{PlaceRole, System};

/// How to check.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// What a state is.
    pub view: View,
    /// In the transition view, leave out runs in which the plant moves for ever and the PLC never scans again.
    pub fair: bool,
    /// How far the exploration may go.
    pub budget: Budget,
    /// The hazards that are no errors. In the scan view nothing is known after the others.
    pub tolerated: Tolerated,
}

impl Default for Options {
    /// The scan view, and no hazard tolerated.
    fn default() -> Self {
        let (budget, tolerated) = (Budget::default(), Tolerated::default());
        Self { view: View::Scan, fair: false, budget, tolerated }
    }
}

/// Explores a system and judges the requirements, which must have been bound for the view. `watch` can end the exploration;
/// what can be decided on a part of the states is decided then.
#[must_use]
pub fn check(
    system: &System,
    requirements: &[(Requirement, Bound)],
    options: Options,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> Report {
    let scan_view;
    let transition_view;
    let view: &dyn SystemView = match options.view {
        View::Scan => {
            let space = ScanSpace::tolerating(system, options.tolerated);
            let graph = explore(&space, options.budget, watch);
            scan_view = ScanView { space, graph };
            &scan_view
        }
        View::Transition => {
            let markings = Markings::explored(&system.net, options.budget, watch);
            transition_view = TransitionView { markings, system };
            &transition_view
        }
    };
    let graph = view.graph();
    let fair = options.fair.then(|| scanning(view, graph));
    let judge = Judge { view, graph, fair: fair.as_ref() };
    let answers = requirements.par_iter().map(|(requirement, bound)| {
        let outcome = judge.outcome(bound);
        let independent = (outcome.verdict() == Verdict::Holds).then(|| independence(bound, system)).flatten();
        Answer { independent, ..Answer::to(requirement, outcome) }
    });
    let answers = answers.collect();
    let unfair = Judge { fair: None, ..judge };
    let ends = match view.scans() {
        Some(space) => scan_ends::on_scans(space, graph),
        None => unfair.outcome(&scan_ends::formula(system)),
    };
    let met = |hazard| match view.scans() {
        Some(space) => hazards::on_scans(space, graph, hazard),
        None => unfair.outcome(&hazards::formula(system, hazard)),
    };
    let hazards = hazards::checked(&system.program, options.tolerated);
    let checks =
        std::iter::once(scan_ends::answer(ends)).chain(hazards.map(|hazard| hazards::answer(hazard, met(hazard))));
    let checks = checks.collect();
    // The first scan is a step too in the scan view, not in the transition view.
    let depth = graph.depth() + usize::from(options.view == View::Scan && !graph.is_empty());
    let (coverage, remarks) = match view.scans() {
        Some(space) => {
            let never =
                whole(graph).and_then(|graph| never_executed(space, graph, &mut || watch(&done(graph)).is_some()));
            let remarks = remarks(space, graph, never.as_deref().unwrap_or_default());
            (Some(coverage(system, requirements.iter().map(|(_, formula)| formula), never)), remarks)
        }
        None => (None, Vec::new()),
    };
    Report {
        exploration: Exploration {
            view: options.view,
            states: graph.len(),
            steps: graph.steps(),
            depth,
            complete: graph.is_complete(),
            stop: graph.stop().clone(),
            bytes: graph.bytes(),
        },
        assumptions: assumptions(system, &options),
        answers,
        checks,
        remarks,
        coverage,
    }
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
        let evident = evidence(no).map(|evidence| (witness(view, graph, &dag, &evidence), evidence));
        match evident {
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
