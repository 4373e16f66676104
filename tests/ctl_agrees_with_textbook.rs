//! The checker's sets of states are those of the textbook definition, on random graphs and formulas; and what it decides on a
//! part of a graph is true of the whole.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

mod support;

use fixedbitset::FixedBitSet;
use petril::explore::{Budget, Graph, StateSpace, Step, explore};
use petril::logic::{Bound, Dag, Node, Quantifier, evidence, label};
use petril::semantics::VarId;
use proptest::prelude::*;
use support::naive_ctl::Kripke;
use support::random_formula;

/// A graph given by lists. State s is of kernel `s / flavours`, and has the successors of its kernel; as a word it is kernel
/// and flavour side by side. Bit v of `marks[s]` is variable v.
#[derive(Debug)]
struct Given {
    flavours: usize,
    /// By kernel.
    successors: Vec<Vec<usize>>,
    marks: Vec<u8>,
    initial: Vec<usize>,
    /// Whether the search is told that steps depend on the kernel only.
    shared: bool,
}

/// The bits of a word that are the kernel.
const KERNEL: [u64; 1] = [0xff];

impl Given {
    fn pack(&self, state: usize) -> u64 {
        (state / self.flavours) as u64 | ((state % self.flavours) as u64) << 8
    }

    fn unpack(&self, word: u64) -> usize {
        (word & KERNEL[0]) as usize * self.flavours + (word >> 8) as usize
    }

    fn atom(&self, formula: &Bound, state: usize) -> bool {
        formula.holds_in(&Marks(self.marks[state])).unwrap()
    }

    fn explored(&self, states: u64) -> Graph {
        explore(self, Budget { states, ..Budget::default() }, &mut |_| None)
    }

    fn name(&self, graph: &Graph, id: u32) -> usize {
        self.unpack(graph.state(id)[0])
    }

    fn kripke(&self, fair: Option<Vec<bool>>) -> Kripke {
        let states = 0..self.successors.len() * self.flavours;
        Kripke { successors: states.map(|s| self.successors[s / self.flavours].clone()).collect(), fair }
    }
}

impl StateSpace for Given {
    fn words(&self) -> usize {
        1
    }

    fn initial(&self, visit: &mut dyn FnMut(Step<'_>)) {
        self.initial.iter().for_each(|&state| visit(Step::To(&[self.pack(state)])));
    }

    fn successors(&self, state: &[u64], visit: &mut dyn FnMut(Step<'_>)) {
        let kernel = &self.successors[(state[0] & KERNEL[0]) as usize];
        kernel.iter().for_each(|&next| visit(Step::To(&[self.pack(next)])));
    }

    fn relevant(&self) -> Option<&[u64]> {
        self.shared.then_some(&KERNEL)
    }
}

struct Marks(u8);

impl petril::logic::Valuation for Marks {
    fn value(&self, variable: VarId) -> u64 {
        u64::from(self.0 >> variable.0 & 1)
    }
    fn is_marked(&self, _: petril::net::PlaceId) -> bool {
        unreachable!()
    }
    fn tokens(&self, _: petril::net::PlaceId) -> u64 {
        unreachable!()
    }
    fn is_enabled(&self, _: petril::net::TransitionId) -> bool {
        unreachable!()
    }
    fn is_deadlock(&self) -> bool {
        unreachable!()
    }
}

fn given() -> impl Strategy<Value = Given> {
    (1..8_usize, 1..4_usize, any::<bool>()).prop_flat_map(|(kernels, flavours, shared)| {
        let n = kernels * flavours;
        let successors = proptest::collection::vec(proptest::collection::vec(0..n, 0..4), kernels);
        let marks = proptest::collection::vec(any::<u8>(), n);
        let initial = proptest::collection::vec(0..n, 1..3);
        let parts = (successors, marks, initial);
        parts.prop_map(move |(successors, marks, initial)| Given { flavours, successors, marks, initial, shared })
    })
}

/// A formula under one more operator, one of those that like to meet themselves.
fn within(f: Bound, operator: usize) -> Bound {
    let (f, constant) = (Box::new(f), |value| Box::new(Bound::Truth(value)));
    let quantifier = if operator < 3 { Quantifier::All } else { Quantifier::Some };
    match operator % 3 {
        0 => Bound::Until { quantifier, weak: true, hold: f, release: constant(false) },
        1 => Bound::Until { quantifier, weak: false, hold: constant(true), release: f },
        _ if operator == 2 => Bound::Not(f),
        _ => Bound::Until { quantifier, weak: false, hold: Box::new(Bound::Variable(VarId(0))), release: f },
    }
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
    let labels = label(graph, &dag, &|f, id| given.atom(f, given.name(graph, id)), fair);
    graph.ids().map(|id| (given.name(graph, id), labels.of(node).contains(id as usize))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(5000))]

    #[test]
    fn on_whole_graphs(given in given(), formula in formula()) {
        let kripke = given.kripke(None);
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
        // Every state gets a way to a fair state, as the checker asks: one more kernel, to which and from which all lead.
        let mut given = given;
        let n = given.marks.len();
        given.successors.iter_mut().for_each(|next| next.push(n));
        given.successors.push((0..n).collect());
        given.marks.extend(std::iter::repeat_n(5, given.flavours));
        let is_fair = |s: usize| s >= n || given.marks[s] & 128 != 0;
        let truth = given.kripke(Some((0..given.marks.len()).map(is_fair).collect()));
        let truth = truth.states(&formula, &|f, s| given.atom(f, s));
        let graph = given.explored(u64::MAX);
        let mut fair = FixedBitSet::with_capacity(graph.len());
        fair.extend(graph.ids().filter(|&id| is_fair(given.name(&graph, id))).map(|id| id as usize));
        for negated in [false, true] {
            for (state, holds) in found(&given, &graph, &formula, negated, Some(&fair)) {
                prop_assert_eq!(holds, truth[state] != negated, "state {}", state);
            }
        }
    }

    /// By the textbook alone: what is left of a formula holds in the same states, also under fairness.
    #[test]
    fn simplified_formulas_hold_in_the_same_states(
        given in given(),
        formula in formula(),
        around in proptest::collection::vec(0..6_usize, 0..4),
        fair in any::<bool>(),
    ) {
        let formula = around.into_iter().fold(formula, within);
        // Every state gets a way to a fair state.
        let n = given.marks.len();
        let mut kripke = given.kripke(fair.then(|| (0..=n).map(|s| s == n || given.marks[s] & 128 != 0).collect::<Vec<_>>()));
        if fair {
            kripke.successors.iter_mut().for_each(|next| next.push(n));
            kripke.successors.push((0..n).collect());
        }
        let marks = |s: usize| given.marks.get(s).copied().unwrap_or(5);
        let atom = |f: &Bound, s: usize| f.holds_in(&Marks(marks(s))).unwrap();
        let left = formula.clone().simplified();
        prop_assert_eq!(kripke.states(&left, &atom), kripke.states(&formula, &atom), "{:?}", left);
        prop_assert_eq!(left.clone().simplified(), left);
    }

    #[test]
    fn on_parts_of_graphs(given in given(), formula in formula(), states in 1..6_u64) {
        let kripke = given.kripke(None);
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
        let labels = label(&graph, &dag, &|f, id| given.atom(f, given.name(&graph, id)), None);
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
            let names: Vec<usize> = evidence.states.iter().map(|&s| given.name(&graph, s)).collect();
            let holds = run.states(&formula, &|f, s| given.atom(f, names[s]));
            prop_assert!(holds[0], "{:?} does not show {:?}", evidence, formula);
        }
    }
}

/// Of two temporal parts of a conjunction a run follows one. Once, it went on with the second where the first had begun,
/// and two of its states did not follow each other.
#[test]
fn a_run_does_not_mix_two_parts_of_a_conjunction() {
    // 0 steps to itself and to 1, which ends; p holds in 0, r in 1.
    let (p, r, never) = (0, 1, 2);
    let marks = vec![1 << p, 1 << r];
    let given = Given { flavours: 1, successors: vec![vec![0, 1], vec![]], marks, initial: vec![0], shared: false };
    let variable = |v| Box::new(Bound::Variable(VarId(v)));
    let next_r = Bound::Next(Quantifier::Some, variable(r));
    let hold = Bound::Truth(false);
    let always_p =
        Bound::Until { quantifier: Quantifier::Some, weak: true, hold: variable(p), release: Box::new(hold) };
    let formula = Bound::And(Box::new(next_r), Box::new(Bound::Or(Box::new(always_p), variable(never))));
    let graph = given.explored(u64::MAX);
    let mut dag = Dag::default();
    let node = dag.add(&formula, false);
    let labels = label(&graph, &dag, &|f, id| given.atom(f, given.name(&graph, id)), None);
    let evidence = evidence(&graph, &dag, &labels, None, node, graph.initial()).unwrap();
    assert_eq!((evidence.states, evidence.loop_start), (vec![0, 1], None));
}

/// Whether one run can show a node: existential operators only, at most one of them in each conjunction, and on the left of
/// untils none.
fn only_existential(dag: &Dag, node: petril::logic::NodeId) -> bool {
    use Quantifier::Some as Exists;
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
