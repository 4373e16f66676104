//! The checker's sets of states are those of the textbook definition, on random graphs and formulas; and what it decides on a
//! part of a graph is true of the whole.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

mod support;

use fixedbitset::FixedBitSet;
use petril::explore::{Budget, Graph, StateSpace, Step, explore};
use petril::logic::{Bound, Dag, Node, evidence, label};
use petril::semantics::VarId;
use proptest::prelude::*;
use support::naive_ctl::Kripke;
use support::random_formula;

/// A graph given by lists: state i is the one word i. Bit v of `marks[i]` is variable v.
#[derive(Debug)]
struct Given {
    successors: Vec<Vec<usize>>,
    marks: Vec<u8>,
    initial: Vec<usize>,
}

impl StateSpace for Given {
    fn words(&self) -> usize {
        1
    }

    fn initial(&self, visit: &mut dyn FnMut(Step<'_>)) {
        self.initial.iter().for_each(|&state| visit(Step::To(&[state as u64])));
    }

    fn successors(&self, state: &[u64], visit: &mut dyn FnMut(Step<'_>)) {
        self.successors[state[0] as usize].iter().for_each(|&next| visit(Step::To(&[next as u64])));
    }
}

impl Given {
    fn atom(&self, formula: &Bound, state: usize) -> bool {
        formula.holds_in(&Marks(self.marks[state])).unwrap()
    }

    fn explored(&self, states: u64) -> Graph {
        explore(self, Budget { states, ..Budget::default() }, &mut |_| None)
    }
}

struct Marks(u8);

impl petril::logic::Valuation for Marks {
    fn variable(&self, variable: VarId) -> bool {
        self.0 >> variable.0 & 1 == 1
    }
    fn is_marked(&self, _: petril::net::PlaceId) -> bool {
        unreachable!()
    }
    fn is_enabled(&self, _: petril::net::TransitionId) -> bool {
        unreachable!()
    }
}

fn given() -> impl Strategy<Value = Given> {
    (1..12_usize).prop_flat_map(|n| {
        let successors = proptest::collection::vec(proptest::collection::vec(0..n, 0..4), n);
        let marks = proptest::collection::vec(any::<u8>(), n);
        let initial = proptest::collection::vec(0..n, 1..3);
        (successors, marks, initial).prop_map(|(successors, marks, initial)| Given { successors, marks, initial })
    })
}

fn formula() -> impl Strategy<Value = Bound> {
    random_formula::formula((0..3).map(|v| Bound::Variable(VarId(v))).collect(), true)
}

/// The set of the whole graph's states that the checker finds for a formula or its negation, as numbers of `given`.
fn found(
    given: &Given,
    graph: &Graph,
    formula: &Bound,
    negated: bool,
    fair: Option<&FixedBitSet>,
) -> Vec<(usize, bool)> {
    let mut dag = Dag::default();
    let node = dag.add(formula, negated);
    let name = |id: u32| graph.state(id)[0] as usize;
    let labels = label(graph, &dag, &|f, id| given.atom(f, name(id)), fair);
    graph.ids().map(|id| (name(id), labels.of(node).contains(id as usize))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn on_whole_graphs(given in given(), formula in formula()) {
        let kripke = Kripke { successors: given.successors.clone(), fair: None };
        let truth = kripke.states(&formula, &|f, s| given.atom(f, s));
        let graph = given.explored(u64::MAX);
        for (state, holds) in found(&given, &graph, &formula, false, None) {
            prop_assert_eq!(holds, truth[state], "state {}", state);
        }
        for (state, holds) in found(&given, &graph, &formula, true, None) {
            prop_assert_eq!(holds, !truth[state], "negated, state {}", state);
        }
    }

    #[test]
    fn under_fairness(given in given(), formula in formula()) {
        // Every state gets a way to a fair state: the checker asks for that.
        let mut given = given;
        let n = given.successors.len();
        given.successors.iter_mut().for_each(|next| next.push(n));
        given.successors.push((0..n).collect());
        given.marks.push(5);
        let is_fair = |s: usize| s == n || given.marks[s] & 128 != 0;
        let kripke = Kripke { successors: given.successors.clone(), fair: Some((0..=n).map(is_fair).collect()) };
        let truth = kripke.states(&formula, &|f, s| given.atom(f, s));
        let graph = given.explored(u64::MAX);
        let mut fair = FixedBitSet::with_capacity(graph.len());
        fair.extend(graph.ids().filter(|&id| is_fair(graph.state(id)[0] as usize)).map(|id| id as usize));
        for negated in [false, true] {
            for (state, holds) in found(&given, &graph, &formula, negated, Some(&fair)) {
                prop_assert_eq!(holds, truth[state] != negated, "state {}", state);
            }
        }
    }

    #[test]
    fn on_parts_of_graphs(given in given(), formula in formula(), states in 1..6_u64) {
        let kripke = Kripke { successors: given.successors.clone(), fair: None };
        let truth = kripke.states(&formula, &|f, s| given.atom(f, s));
        let graph = given.explored(states);
        for negated in [false, true] {
            for (state, shown) in found(&given, &graph, &formula, negated, None) {
                prop_assert!(!shown || truth[state] != negated, "state {} is claimed wrongly", state);
            }
        }
    }

    #[test]
    fn evidence_is_a_run_that_shows_it(given in given(), formula in formula()) {
        let graph = given.explored(u64::MAX);
        let mut dag = Dag::default();
        let node = dag.add(&formula, false);
        let labels = label(&graph, &dag, &|f, id| given.atom(f, graph.state(id)[0] as usize), None);
        let somewhere = graph.initial().iter().any(|&s| labels.of(node).contains(s as usize));
        let evidence = evidence(&graph, &dag, &labels, None, node, graph.initial());
        prop_assert_eq!(evidence.is_some(), somewhere);
        let Some(evidence) = evidence else { return Ok(()) };
        prop_assert!(graph.initial().contains(&evidence.states[0]));
        let closing = evidence.loop_start.map(|start| evidence.states[start]);
        for (from, to) in evidence.states.iter().zip(evidence.states.iter().skip(1).copied().chain(closing)) {
            prop_assert!(graph.successors(*from).contains(&to));
        }
        for claim in &evidence.claims {
            prop_assert!(labels.of(claim.node).contains(evidence.states[claim.position] as usize));
        }
        // The formula itself, read on this one run, holds: the run is a graph in which every path is it.
        if only_existential(&dag, node) {
            let n = evidence.states.len();
            let mut successors: Vec<Vec<usize>> = (1..n).map(|s| vec![s]).collect();
            successors.push(evidence.loop_start.into_iter().collect());
            let run = Kripke { successors, fair: None };
            let names: Vec<usize> = evidence.states.iter().map(|&s| graph.state(s)[0] as usize).collect();
            let holds = run.states(&formula, &|f, s| given.atom(f, names[s]));
            prop_assert!(holds[0], "{:?} does not show {:?}", evidence, formula);
        }
    }
}

/// Whether one run can show a node: existential operators only, at most one of them in each conjunction, and on the left of
/// untils none.
fn only_existential(dag: &Dag, node: petril::logic::NodeId) -> bool {
    use petril::logic::Quantifier::Some as Exists;
    let is_state = |node| matches!(dag.node(node), Node::State { .. });
    match *dag.node(node) {
        Node::State { .. } => true,
        Node::And(f, g) => (is_state(f) && only_existential(dag, g)) || (is_state(g) && only_existential(dag, f)),
        Node::Or(f, g) => only_existential(dag, f) && only_existential(dag, g),
        Node::Next(Exists, f) => only_existential(dag, f),
        Node::Until(Exists, f, g) | Node::WeakUntil(Exists, f, g) => is_state(f) && only_existential(dag, g),
        _ => false,
    }
}
