//! Formulas about paths, labelled on the whole graph.

use fixedbitset::FixedBitSet;

use super::hunt::Seen;
use super::replay::{Played, refuted, replayed};
use super::{Reply, Run};
use crate::explore::engine::Exploration;
use crate::explore::{Graph, Stop};
use crate::logic::{Bound, Dag, Labels, Node, NodeId, evidence, label_from};
use crate::net::{Net, TransitionId};
use crate::verdict::check::is_existential;

/// The whole graph, for formulas about paths.
pub(super) struct Paths<'e> {
    net: &'e Net,
    exploration: &'e Exploration,
    graph: Graph,
    /// Where the firings of each state begin in `fired`.
    starts: Vec<u64>,
    /// The transition of each step, in the order of the graph's rows.
    fired: Vec<u32>,
}

impl<'e> Paths<'e> {
    /// The graph, or why there is none.
    pub(super) fn of(net: &'e Net, exploration: &'e Exploration) -> Result<Self, String> {
        if exploration.stop != Stop::Complete {
            return Err(exploration.stop.to_string());
        }
        let steps = exploration.steps(true).ok_or("the graph has too many states")?;
        let (starts, targets, fired) = steps.into_parts();
        let graph = Graph::of_rows(starts.clone(), targets);
        Ok(Self { net, exploration, graph, starts, fired })
    }

    /// Whether a formula holds at the beginning.
    pub(super) fn reply(&self, formula: &Bound) -> Reply {
        let mut dag = Dag::default();
        let (yes, no) = (dag.add(formula, false), dag.add(formula, true));
        let mut atoms = self.atoms(&dag);
        let labels = label_from(&self.graph, &dag, &mut |node, _| std::mem::take(&mut atoms[node.index()]), None);
        let holds = labels.of(yes).contains(0);
        let shows = if holds { yes } else { no };
        let run = if is_existential(&dag, shows) { self.run(&dag, &labels, shows) } else { Ok(None) };
        match run {
            Ok(run) if holds => Reply::Holds(run),
            Ok(run) => Reply::Violated(run),
            Err(what) => refuted(&what),
        }
    }

    /// The states in which each formula about one state holds.
    fn atoms(&self, dag: &Dag) -> Vec<FixedBitSet> {
        let states = self.graph.len();
        let mut sets: Vec<FixedBitSet> = dag.nodes().iter().map(|_| FixedBitSet::new()).collect();
        let formulas = dag.nodes().iter().enumerate().filter_map(|(position, node)| match node {
            Node::State { formula, .. } => Some((position, formula)),
            _ => None,
        });
        let formulas: Vec<(usize, &Bound)> = formulas.collect();
        formulas.iter().for_each(|&(position, _)| sets[position].grow(states));
        self.exploration.for_each_state(|state, view| {
            for &(position, formula) in &formulas {
                if formula.holds_in(&Seen(view)) == Some(true) {
                    sets[position].insert(state as usize);
                }
            }
        });
        sets
    }

    /// A run that shows a node at the initial state, replayed with everything it claims of single states.
    fn run(&self, dag: &Dag, labels: &Labels, node: NodeId) -> Result<Option<Run>, String> {
        let Some(evidence) = evidence(&self.graph, dag, labels, None, node, &[0]) else { return Ok(None) };
        let targets = evidence.states.iter().skip(1).copied().chain(evidence.loop_start.map(|i| evidence.states[i]));
        let firings = evidence.states.iter().zip(targets).map(|(&from, to)| {
            let position = self.graph.successors(from).iter().position(|&target| target == to)?;
            Some(TransitionId::at(self.fired[self.starts[from as usize] as usize + position] as usize))
        });
        let firings: Option<Vec<TransitionId>> = firings.collect();
        let run = Run { firings: firings.ok_or("a step is not there")?, loop_start: evidence.loop_start };
        let markings = replayed(self.net, &run)?;
        for claim in &evidence.claims {
            if let Node::State { formula, negated } = dag.node(claim.node)
                && formula.holds_in(&Played(self.net, &markings[claim.position])) != Some(!*negated)
            {
                return Err(format!("marking {} does not show it", claim.position));
            }
        }
        Ok(Some(run))
    }
}
