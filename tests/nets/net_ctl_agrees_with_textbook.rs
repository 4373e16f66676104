//! Answers about random nets with weights and deadlocks are those of the textbook; and what is answered on a part of the states is
//! true of all of them.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeMap;

use petril::explore::Budget;
use petril::explore::engine::{Model, Options};
use petril::logic::{Bound, Comparison, Quantifier, Term};
use petril::net::{Builder, Net, PlaceId, Tokens, TransitionId};
use petril::verdict::{Examination, Question, Reply, Run, judge};
use proptest::prelude::*;
use support::naive_ctl::Kripke;
use support::naive_nets::{Marking, Naive, fire, search};
use support::naive_partial::At;
use support::random_formula;

const PLACES: usize = 4;

const TRANSITIONS: usize = 5;

/// Arcs as places with weights.
type Side = Vec<(usize, u64)>;

fn net(initial: &[u64], transitions: &[(Side, Side)]) -> Net {
    let mut builder = Builder::new("random");
    let places: Vec<PlaceId> =
        initial.iter().zip(["a", "b", "c", "d"]).map(|(&n, name)| builder.place_with(name, n)).collect();
    for (number, (pre, post)) in transitions.iter().enumerate() {
        let arcs = |side: &Side| side.iter().map(|&(place, weight)| (places[place], weight)).collect::<Vec<_>>();
        builder.weighted(format!("t{number}"), &arcs(pre), &arcs(post), &[]);
    }
    builder.build()
}

fn nets() -> impl Strategy<Value = Net> {
    let side = || proptest::collection::vec((0..PLACES, 1..3_u64), 0..3);
    let initial = proptest::collection::vec(0..4_u64, PLACES);
    let transitions = proptest::collection::vec((side(), side()), TRANSITIONS);
    (initial, transitions).prop_map(|(initial, transitions)| net(&initial, &transitions))
}

fn formulas() -> impl Strategy<Value = Bound> {
    let tokens = |place, n| {
        let (a, b) = (Term::Tokens(PlaceId::at(place)), Term::Number(n));
        Bound::Compare(Comparison::AtLeast, a, b)
    };
    let mut atoms = vec![Bound::Deadlock];
    atoms.extend((0..PLACES).flat_map(|place| [1, 2].map(|n| tokens(place, n))));
    atoms.extend((0..PLACES).map(|place| Bound::Marked(PlaceId::at(place))));
    atoms.extend((0..TRANSITIONS).map(|transition| Bound::Enabled(TransitionId::at(transition))));
    random_formula::formula(atoms, true)
}

/// Whether a formula holds at the beginning; nothing if there are too many markings.
fn textbook(net: &Net, formulas: &[Bound]) -> Option<Vec<bool>> {
    let model = Model::from(net);
    let naive = search(&model, 300)?;
    let markings: Vec<&Marking> = naive.markings.keys().collect();
    let numbers: BTreeMap<&Marking, usize> = markings.iter().enumerate().map(|(number, &m)| (m, number)).collect();
    let mut successors = vec![Vec::new(); markings.len()];
    naive.steps.iter().for_each(|(from, _, to)| successors[numbers[from]].push(numbers[to]));
    let kripke = Kripke::new(successors);
    let initial = numbers[&model.initial];
    let atom = |formula: &Bound, state: usize| formula.holds_in(&At(&model, markings[state])).unwrap();
    Some(formulas.iter().map(|formula| kripke.states(formula, &atom)[initial]).collect())
}

/// Plays a run and those that branch off it.
fn play(net: &Net, run: &Run, from: &Tokens) {
    let mut markings = vec![from.clone()];
    for &transition in &run.firings {
        let mut tokens = markings[markings.len() - 1].clone();
        assert!(net.has_concession(&tokens, transition));
        net.play(&mut tokens, transition).unwrap();
        markings.push(tokens);
    }
    if let Some(start) = run.loop_start {
        assert!(start < run.firings.len());
        assert_eq!(markings[start], markings[markings.len() - 1]);
    }
    for branch in &run.branches {
        branch.run.iter().for_each(|run| play(net, run, &markings[branch.at]));
    }
}

/// The answers to the contest's examinations, in their order, by their definitions.
fn examined(net: &Net, naive: &Naive) -> Vec<bool> {
    let model = Model::from(net);
    let markings = || naive.markings.keys();
    let enabled = |marking: &Marking| {
        (0..TRANSITIONS).filter(|&t| fire(&model.transitions[t], marking).is_some()).collect::<Vec<usize>>()
    };
    // For each marking, the transitions that can still fire.
    let mut can: BTreeMap<&Marking, Vec<bool>> = markings().map(|m| (m, vec![false; TRANSITIONS])).collect();
    for _ in 0..=naive.markings.len() {
        for (from, transition, to) in &naive.steps {
            let mut later = can[to].clone();
            later[*transition] = true;
            can.entry(from).and_modify(|own| own.iter_mut().zip(later).for_each(|(own, later)| *own |= later));
        }
    }
    let is_stable = |place: usize| markings().all(|marking| marking[place] == model.initial[place]);
    vec![
        markings().any(|marking| enabled(marking).is_empty()),
        markings().flatten().all(|&tokens| tokens <= 1),
        (0..PLACES).any(is_stable),
        can[&model.initial].iter().all(|&can| can),
        can.values().flatten().all(|&can| can),
    ]
}

/// The answers, which may be missing if there is a limit.
fn judged(net: &Net, formulas: &[Bound], states: u64, threads: usize) -> Vec<Option<bool>> {
    let questions: Vec<Question> = formulas.iter().cloned().map(Question::Holds).collect();
    answered(net, &questions, states, threads)
}

fn answered(net: &Net, questions: &[Question], states: u64, threads: usize) -> Vec<Option<bool>> {
    let budget = Budget { states, ..Budget::default() };
    let options = Options { budget, threads, ..Options::default() };
    let report = judge(net, questions, &options, &mut |_| None);
    let answer = |reply: &Reply| {
        let (holds, run) = match reply {
            Reply::Holds(run) => (true, run),
            Reply::Violated(run) => (false, run),
            Reply::Unknown(reason) => {
                assert!(reason.contains("limit"), "{reason}");
                return None;
            }
            Reply::Most(_) => unreachable!(),
        };
        run.iter().for_each(|run| play(net, run, &net.initial_tokens()));
        Some(holds)
    };
    report.replies.iter().map(answer).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn examinations_are_those_of_their_definitions(net in nets(), limit in 1..30_u64, threads in 1..3_usize) {
        let Some(naive) = search(&Model::from(&net), 100) else { return Ok(()) };
        let expected: Vec<Option<bool>> = examined(&net, &naive).into_iter().map(Some).collect();
        let questions = Examination::ALL.map(Examination::question);
        prop_assert_eq!(&answered(&net, &questions, 1000, threads), &expected);
        for (part, whole) in answered(&net, &questions, limit, threads).iter().zip(&expected) {
            prop_assert!(part.is_none() || part == whole, "{part:?} of {limit} states, {whole:?} of all");
        }
    }

    #[test]
    fn answers_are_those_of_the_textbook(
        net in nets(),
        formulas in proptest::collection::vec(formulas(), 1..6),
        limit in 1..30_u64,
        threads in 1..3_usize,
    ) {
        let Some(expected) = textbook(&net, &formulas) else { return Ok(()) };
        let expected: Vec<Option<bool>> = expected.into_iter().map(Some).collect();
        prop_assert_eq!(&judged(&net, &formulas, 1000, threads), &expected);
        let simplified: Vec<Bound> = formulas.iter().cloned().map(Bound::simplified).collect();
        prop_assert_eq!(&judged(&net, &simplified, 1000, threads), &expected);
        for (part, whole) in judged(&net, &formulas, limit, threads).iter().zip(&expected) {
            prop_assert!(part.is_none() || part == whole, "{part:?} of {limit} states, {whole:?} of all");
        }
    }
}

#[test]
fn what_is_decided_near_by_is_answered_without_all_states() {
    // A counter without end.
    let net = net(&[0, 0, 0, 0], &[(vec![], vec![(0, 1)])]);
    let counted = |comparison, n| Bound::Compare(comparison, Term::Tokens(PlaceId::at(0)), Term::Number(n));
    let truth = |value| Box::new(Bound::Truth(value));
    let some =
        |f: Bound| Bound::Until { quantifier: Quantifier::Some, weak: false, hold: truth(true), release: Box::new(f) };
    let always =
        |f: Bound| Bound::Until { quantifier: Quantifier::All, weak: true, hold: Box::new(f), release: truth(false) };
    let next = |f: Bound| Bound::Next(Quantifier::All, Box::new(f));
    let formulas = [
        next(next(counted(Comparison::Equal, 2))),
        some(counted(Comparison::Equal, 100)),
        // The nearest states do not tell whether it will be 0 again.
        always(some(counted(Comparison::Equal, 0))),
        // Its first part decides.
        Bound::Or(
            Box::new(some(next(counted(Comparison::Equal, 7)))),
            Box::new(always(some(counted(Comparison::Equal, 0)))),
        ),
        always(next(counted(Comparison::AtMost, 50))),
    ];
    for threads in [1, 2] {
        let answers = judged(&net, &formulas, 1000, threads);
        assert_eq!(answers, [Some(true), Some(true), None, Some(true), Some(false)]);
        let live = Examination::ALL.map(Examination::question);
        assert_eq!(answered(&net, &live, 1000, threads), [Some(false), Some(false), Some(true), Some(true), None]);
    }
}
