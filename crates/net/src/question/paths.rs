//! Branching-time formulas, labelled on the reachability graph; on a partial graph, only what holds whatever the
//! unknown states are counts.

use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use super::atoms::Atoms;
use super::explain::explain;
use super::hunt::Hunt;
use super::live::live;
use super::replay::refuted;
use super::{Reply, Run};
use crate::engine::Exploration;
use crate::net::Net;
use petril_logic::{Bound, Dag, NodeId, label_from};
use petril_search::{Graph, Stop};

/// Reachability graph of an exploration.
pub(super) struct Paths<'e> {
    pub(super) net: &'e Net,
    pub(super) exploration: &'e Exploration,
    pub(super) graph: Graph,
}

impl<'e> Paths<'e> {
    /// Builds the graph; `None` if `stopping` is set meanwhile, or there are too many states.
    pub(super) fn of(net: &'e Net, exploration: &'e Exploration, stopping: &AtomicBool) -> Option<Self> {
        let (starts, targets) = exploration.steps(stopping)?.into_parts();
        let graph = Graph::of_rows(exploration.kept(), starts, targets, exploration.stop.clone());
        Some(Self { net, exploration, graph })
    }

    /// Estimate in bytes of the graph and of what is needed to build it.
    pub(super) fn bytes(exploration: &Exploration) -> u64 {
        let figures = &exploration.figures;
        let steps = figures.transitions as f64 / figures.expanded.max(1) as f64 * 4.0;
        figures.bytes + figures.states * 24 + (figures.states as f64 * steps) as u64
    }

    /// Answers to the properties, computed in parallel.
    pub(super) fn replies(&self, hunts: &[&Hunt<'_>], stopping: &AtomicBool) -> Vec<Option<Reply>> {
        let sides = |hunt: &&Hunt<'_>| match hunt {
            Hunt::Paths(formula) => Some([false, true].map(|negated| Side::of(formula, negated))),
            _ => None,
        };
        let sides: Vec<Option<[Side; 2]>> = hunts.iter().map(sides).collect();
        let dags = sides.iter().flatten().flatten().map(|side| &side.dag);
        let Some(atoms) = Atoms::of(self.exploration, dags, stopping) else { return Vec::new() };
        let reply = |sides: &Option<[Side; 2]>| match sides {
            Some(sides) => self.reply(sides, &atoms, stopping),
            None => live(self, stopping),
        };
        sides.par_iter().map(reply).collect()
    }

    fn reply(&self, [yes, no]: &[Side; 2], atoms: &Atoms<'_>, stopping: &AtomicBool) -> Option<Reply> {
        if let Some(run) = self.shown(yes, atoms, stopping)? {
            return Some(run.map_or_else(|what| refuted(&what), Reply::Holds));
        }
        if self.graph.stop() == &Stop::Complete && !no.is_existential() {
            return Some(Reply::Violated(None));
        }
        let run = self.shown(no, atoms, stopping)??;
        Some(run.map_or_else(|what| refuted(&what), Reply::Violated))
    }

    /// Run that shows one side at the initial marking, replayed, if that side holds there; outer `None` if stopped.
    fn shown(
        &self,
        side: &Side,
        atoms: &Atoms<'_>,
        stopping: &AtomicBool,
    ) -> Option<Option<Result<Option<Run>, String>>> {
        let holding = |formula: &Bound, negated| atoms.holding(formula, negated, self.graph.len());
        let labels = label_from(&self.graph, &side.dag, &holding, stopping)?;
        let holds = labels.of(side.root).contains(0);
        Some(holds.then(|| if side.is_existential() { explain(self, &side.dag, &labels, side.root) } else { Ok(None) }))
    }
}

/// A formula or its negation, in negation normal form.
struct Side {
    dag: Dag,
    root: NodeId,
}

impl Side {
    fn of(formula: &Bound, negated: bool) -> Self {
        let mut dag = Dag::default();
        let root = dag.add(formula, negated);
        Self { dag, root }
    }

    /// Whether a run can show the formula.
    fn is_existential(&self) -> bool {
        self.dag.is_existential(self.root)
    }
}
