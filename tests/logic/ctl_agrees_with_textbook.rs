//! The checker's sets of states are those of the textbook definition, on random graphs and formulas; and what it decides on a
//! part of a graph is true of the whole.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::explore::Graph;
use petril::logic::{Bound, Dag, Fairness, Node, Quantifier, evidence, label};
use petril::semantics::VarId;
use proptest::prelude::*;
use support::naive_ctl::{Fair, Kripke};
use support::random_formula;
use support::random_graph::{Given, Marks, given, given_in_part, given_of, masks};

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
    fairness: Option<&Fairness>,
) -> Vec<(usize, bool)> {
    let mut dag = Dag::default();
    let node = dag.add(formula, negated);
    let labels = label(graph, &dag, &|f, id| given.atom(f, given.name(graph, id)), fairness);
    graph.ids().map(|id| (given.name(graph, id), labels.of(node).contains(id as usize))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(5000))]

    #[test]
    fn on_whole_graphs(given in given(), formula in formula()) {
        let kripke = given.kripke();
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
    fn under_fairness(given in given_of(6, 3), masks in masks(), formula in formula()) {
        let kripke = masks.kripke(&given);
        let truth = kripke.states(&formula, &|f, s| given.atom(f, s));
        let graph = given.explored(u64::MAX);
        let fairness = masks.on(&given, &graph);
        for id in graph.ids() {
            let counts = kripke.counting()[given.name(&graph, id)];
            prop_assert_eq!(fairness.surely().contains(id as usize), counts);
            prop_assert_eq!(fairness.possibly().contains(id as usize), counts);
        }
        for negated in [false, true] {
            for (state, holds) in found(&given, &graph, &formula, negated, Some(&fairness)) {
                prop_assert_eq!(holds, truth[state] != negated, "state {}", state);
            }
        }
    }

    #[test]
    fn under_fairness_on_parts_of_graphs(
        (given, states) in given_in_part(6, 3),
        masks in masks(),
        formula in formula(),
    ) {
        let kripke = masks.kripke(&given);
        let truth = kripke.states(&formula, &|f, s| given.atom(f, s));
        let graph = given.explored(states);
        let fairness = masks.on(&given, &graph);
        for id in graph.ids() {
            let counts = kripke.counting()[given.name(&graph, id)];
            prop_assert!(counts || !fairness.surely().contains(id as usize));
            prop_assert!(!counts || fairness.possibly().contains(id as usize));
        }
        for negated in [false, true] {
            for (state, shown) in found(&given, &graph, &formula, negated, Some(&fairness)) {
                prop_assert!(!shown || truth[state] != negated, "state {} is claimed wrongly", state);
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
        let mut successors = given.lists();
        let mut kripke = Kripke::new(successors.clone());
        if fair {
            successors.iter_mut().for_each(|next| next.push(n));
            successors.push((0..n).collect());
            let again = (0..=n).map(|s| s == n || given.marks[s] & 128 != 0).collect();
            kripke = Kripke::under(Fair::Again(vec![again]), successors);
        }
        let marks = |s: usize| given.marks.get(s).copied().unwrap_or(5);
        let atom = |f: &Bound, s: usize| f.holds_in(&Marks(marks(s))).unwrap();
        let left = formula.clone().simplified();
        prop_assert_eq!(kripke.states(&left, &atom), kripke.states(&formula, &atom), "{:?}", left);
        prop_assert_eq!(left.clone().simplified(), left);
    }

    #[test]
    fn on_parts_of_graphs((given, states) in given_in_part(8, 4), formula in formula()) {
        let kripke = given.kripke();
        let truth = kripke.states(&formula, &|f, s| given.atom(f, s));
        let graph = given.explored(states);
        for negated in [false, true] {
            for (state, shown) in found(&given, &graph, &formula, negated, None) {
                prop_assert!(!shown || truth[state] != negated, "state {} is claimed wrongly", state);
            }
        }
    }

    #[test]
    fn evidence_is_a_run_that_shows_it(
        (given, states) in given_in_part(6, 3),
        masks in proptest::option::of(masks()),
        formula in formula(),
    ) {
        let graph = given.explored(states);
        let fairness = masks.as_ref().map(|masks| masks.on(&given, &graph));
        let mut dag = Dag::default();
        let node = dag.add(&formula, false);
        let labels = label(&graph, &dag, &|f, id| given.atom(f, given.name(&graph, id)), fairness.as_ref());
        let counts = |id: &u32| fairness.as_ref().is_none_or(|fairness| fairness.surely().contains(*id as usize));
        let starts: Vec<u32> = graph.initial().iter().copied().filter(counts).collect();
        let somewhere = starts.iter().any(|&s| labels.of(node).contains(s as usize));
        let evidence = evidence(&graph, &dag, &labels, fairness.as_ref(), node, &starts);
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
        // The run counts, or can be continued so that it does.
        let names: Vec<usize> = evidence.states.iter().map(|&s| given.name(&graph, s)).collect();
        if let Some(masks) = &masks {
            let kripke = masks.kripke(&given);
            match evidence.loop_start {
                Some(start) => prop_assert!(masks.are_met_by(&names[start..]), "{:?} {:?}", names, masks),
                None => prop_assert!(kripke.counting()[names[names.len() - 1]]),
            }
        }
        // The formula itself, read on this one run, holds: the run is a graph in which every path is it.
        if only_existential(&dag, node) {
            let n = evidence.states.len();
            let mut successors: Vec<Vec<usize>> = (1..n).map(|s| vec![s]).collect();
            successors.push(evidence.loop_start.into_iter().collect());
            let run = Kripke::new(successors);
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
    let given = Given {
        flavours: 1,
        successors: vec![vec![0, 1], vec![]],
        marks,
        initial: vec![0],
        shared: false,
        hidden: vec![false; 2],
    };
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
