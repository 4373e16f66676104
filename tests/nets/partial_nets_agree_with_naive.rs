//! Nets that grow without end, or are too large for the limit: what is answered on the states explored is what the definitions
//! say of them in three values (`support/naive_partial.rs`), and true of the whole net where that is finite; under every limit, on one
//! to four threads.
//!
//! `PETRIL_NETS=20000 PROPTEST_RNG_SEED=1` for a long run that can be repeated.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

use petril::explore::engine::{Arcs, Exploration, Model, Options, View, Wanted, explore};
use petril::explore::{Budget, Stop};
use petril::logic::{Bound, Comparison, Quantifier, Term};
use petril::net::{Net, PlaceId, TransitionId};
use petril::verdict::{Examination, Means, NetReport, Question, Reply, Run, judge};
use proptest::prelude::*;
use proptest::sample::select;
use support::growing_net::{growing_model, net_of};
use support::naive_nets::{Marking, fire};
use support::naive_partial::Partial;
use support::random_formula;

/// How many random nets are tried: `PETRIL_NETS`, if it is set.
fn nets(usual: u32) -> ProptestConfig {
    let nets = std::env::var("PETRIL_NETS").ok().and_then(|count| count.parse().ok());
    ProptestConfig { max_shrink_iters: 2000, ..ProptestConfig::with_cases(nets.unwrap_or(usual)) }
}

/// Where an exploration is to stop.
#[derive(Clone, Copy, Debug)]
enum Limit {
    States(u64),
    Bytes(u64),
    /// After that many looks at the clock.
    Looks(u32),
}

fn limits() -> impl Strategy<Value = Limit> {
    prop_oneof![
        4 => select(vec![1, 2, 3, 5, 8, 13, 30, 80]).prop_map(Limit::States),
        1 => (0..200_000_u64).prop_map(Limit::Bytes),
        2 => (1..12_u32).prop_map(Limit::Looks),
    ]
}

impl Limit {
    fn options(self, threads: usize) -> Options {
        let mut budget = Budget { states: 400, ..Budget::default() };
        match self {
            Self::States(states) => budget.states = states,
            Self::Bytes(bytes) => budget.bytes = bytes,
            Self::Looks(_) => {}
        }
        Options { budget, threads, keep: true }
    }

    fn watch(self) -> impl FnMut(&petril::explore::Progress) -> Option<String> {
        let mut looks = 0;
        move |_| {
            looks += 1;
            matches!(self, Self::Looks(most) if looks > most).then(|| "the limit of looks".to_owned())
        }
    }
}

/// Formulas about a net: of branching time, and a few about reachability.
fn formulas(model: &Model) -> impl Strategy<Value = Vec<Bound>> + use<> {
    let compare = |place: usize, comparison, n: u64| {
        Bound::Compare(comparison, Term::Tokens(PlaceId::at(place)), Term::Number(n.into()))
    };
    let mut atoms = vec![Bound::Deadlock];
    for (place, &tokens) in model.initial.iter().enumerate() {
        for more in [0, 1, 2, 3, 4, 7, 8, 15, 16] {
            atoms.push(compare(place, Comparison::AtLeast, tokens + more));
        }
        atoms.push(compare(place, Comparison::Equal, tokens));
        atoms.push(compare(place, Comparison::Equal, 0));
        atoms.push(Bound::Marked(PlaceId::at(place)));
    }
    atoms.extend((0..model.transitions.len()).map(|transition| Bound::Enabled(TransitionId::at(transition))));
    let random = random_formula::formula(atoms.clone(), true);
    let often = (select(atoms), any::<bool>(), any::<bool>()).prop_map(|(atom, next, dual)| {
        let often = always(possibly(atom.clone()));
        let formula = if dual { possibly(always(atom)) } else { often };
        if next { Bound::Next(Quantifier::Some, Box::new(formula)) } else { formula }
    });
    prop::collection::vec(prop_oneof![2 => random, 1 => often], 1..4)
}

fn until(quantifier: Quantifier, weak: bool, hold: Bound, release: Bound) -> Bound {
    Bound::Until { quantifier, weak, hold: Box::new(hold), release: Box::new(release) }
}

fn possibly(f: Bound) -> Bound {
    until(Quantifier::Some, false, Bound::Truth(true), f)
}

fn always(f: Bound) -> Bound {
    until(Quantifier::All, true, f, Bound::Truth(false))
}

/// An examination as a formula.
fn definition(examination: Examination, model: &Model) -> Bound {
    let all = |formulas: Vec<Bound>| {
        formulas.into_iter().fold(Bound::Truth(true), |f, g| Bound::And(Box::new(f), Box::new(g)))
    };
    let tokens = |place, comparison, n: u64| {
        Bound::Compare(comparison, Term::Tokens(PlaceId::at(place)), Term::Number(n.into()))
    };
    let places = 0..model.initial.len();
    let enabled = (0..model.transitions.len()).map(|transition| Bound::Enabled(TransitionId::at(transition)));
    match examination {
        Examination::ReachabilityDeadlock => possibly(Bound::Deadlock),
        Examination::OneSafe => always(all(places.map(|place| tokens(place, Comparison::AtMost, 1)).collect())),
        Examination::StableMarking => {
            let stable = places.map(|place| always(tokens(place, Comparison::Equal, model.initial[place])));
            let never = |f: Bound| Bound::Not(Box::new(f));
            never(all(stable.map(never).collect()))
        }
        Examination::QuasiLiveness => all(enabled.map(possibly).collect()),
        Examination::Liveness => all(enabled.map(|enabled| always(possibly(enabled))).collect()),
    }
}

/// The tokens that no transition changes stay as they are, without looking at any marking.
fn has_constant_place(model: &Model) -> bool {
    (0..model.initial.len() as u32).any(|place| {
        let sum = |side: &[(u32, u64)]| side.iter().filter(|arc| arc.0 == place).map(|arc| arc.1).sum::<u64>();
        model.transitions.iter().all(|arcs| sum(&arcs.pre) == sum(&arcs.post))
    })
}

/// The answer, if there is one. Its runs are played.
fn answer(net: &Net, reply: &Reply) -> Option<bool> {
    let (holds, run) = match reply {
        Reply::Holds(run) => (true, run),
        Reply::Violated(run) => (false, run),
        Reply::Unknown(reason) => {
            assert!(reason.contains("limit") || reason.contains("2^62"), "{reason}");
            return None;
        }
        Reply::Most(_) => unreachable!(),
    };
    run.iter().for_each(|run| play(net, run, net.initial_tokens().as_slice()));
    Some(holds)
}

/// Plays a run and those that branch off it.
fn play(net: &Net, run: &Run, from: &[u64]) {
    let model = Model::from(net);
    let mut markings: Vec<Marking> = vec![from.to_vec()];
    for transition in &run.firings {
        let next = fire(&model.transitions[transition.index()], &markings[markings.len() - 1]);
        markings.push(next.expect("a run fires what is enabled"));
    }
    if let Some(start) = run.loop_start {
        assert_eq!(markings[start], markings[markings.len() - 1]);
    }
    for branch in &run.branches {
        branch.run.iter().for_each(|run| play(net, run, &markings[branch.at]));
    }
}

/// Markings looked at by the naive checker.
const MOST: usize = 1500;

/// Compares the answers to formulas about a net, explored within a limit, with the naive ones.
fn compare(model: &Model, questions: &[(Question, Bound)], limit: Limit, threads: usize) -> Result<(), TestCaseError> {
    let net = net_of(model);
    let asked: Vec<Question> = questions.iter().map(|(question, _)| question.clone()).collect();
    let report: NetReport = judge(&net, &asked, &limit.options(threads), &mut limit.watch());
    let depth = if report.figures.expanded == 0 { 0 } else { report.figures.depth };
    // All that was expanded, or, if that is too much, the nearest part of it.
    let naive = Partial::of(model, depth, MOST);
    let holds_all = naive.is_complete() || naive.markings.len() <= MOST;
    let deeper = Partial::of(model, usize::MAX, MOST / 3);
    for (((question, formula), reply), means) in questions.iter().zip(&report.replies).zip(&report.means) {
        let Some(found) = answer(&net, reply) else {
            // The graph of all states may need more memory, or time, than there is.
            let must = report.stop == Stop::Complete && matches!(limit, Limit::States(_));
            prop_assert!(!must, "no answer to {formula:?} from all states");
            continue;
        };
        let by_exploration = means.iter().all(|means| *means == Means::Exploration);
        let structural =
            matches!(question, Question::Examination(Examination::StableMarking)) && has_constant_place(model);
        for expected in [naive.answer(formula), deeper.answer(formula)].into_iter().flatten() {
            prop_assert_eq!(found, expected, "{:?} under {:?} on {} threads by {:?}", formula, limit, threads, means);
        }
        if by_exploration && holds_all && !structural {
            let why = format!("{formula:?} is said to be {found} under {limit:?} on {threads} threads");
            prop_assert!(naive.answer(formula).is_some(), "{why}, but these states do not tell");
        }
    }
    Ok(())
}

fn questions(formulas: Vec<Bound>) -> Vec<(Question, Bound)> {
    formulas.into_iter().map(|formula| (Question::Holds(formula.clone()), formula)).collect()
}

/// A net with formulas about it.
fn with_formulas() -> impl Strategy<Value = (Model, Vec<Bound>)> {
    growing_model()
        .prop_flat_map(|model| (formulas(&model), Just(model)).prop_map(|(formulas, model)| (model, formulas)))
}

/// The states kept are markings that can be reached, expanded ones first, in the order of their distances; the rows are those of
/// the expanded ones, and each step leads where firing leads, or to no state kept.
fn check_rows(model: &Model, exploration: &Exploration) -> Result<(), TestCaseError> {
    let mut markings: Vec<Marking> = Vec::new();
    exploration.for_each_state(|_, view| markings.push(view.marking()));
    prop_assert_eq!(markings.len(), exploration.kept());
    let (kept, expanded) = (markings.len() as u32, exploration.expanded());
    prop_assert_eq!(expanded as u64, exploration.figures.expanded);
    if markings.is_empty() {
        return Ok(());
    }
    prop_assert_eq!(&markings[0], &model.initial);
    let numbers: std::collections::BTreeMap<&Marking, u32> = markings.iter().zip(0..).collect();
    prop_assert_eq!(numbers.len(), markings.len());
    let steps = exploration.steps(&AtomicBool::new(false)).unwrap();
    prop_assert_eq!(steps.rows(), expanded);
    let mut reached = BTreeSet::from([0]);
    for state in 0..expanded as u32 {
        prop_assert!(reached.contains(&state), "state {} has no predecessor before it", state);
        let after: Vec<Marking> =
            model.transitions.iter().filter_map(|arcs| fire(arcs, &markings[state as usize])).collect();
        let row: Vec<u32> = after.iter().map(|after| numbers.get(after).copied().unwrap_or(kept)).collect();
        prop_assert_eq!(steps.successors(state), &row[..], "steps of {:?}", &markings[state as usize]);
        reached.extend(row);
    }
    prop_assert!((0..kept).all(|state| reached.contains(&state)));
    Ok(())
}

proptest! {
    #![proptest_config(nets(300))]

    #[test]
    fn formulas_about_parts((model, formulas) in with_formulas(), limits in prop::collection::vec((limits(), 1..5_usize), 3)) {
        let questions = questions(formulas);
        for (limit, threads) in limits {
            compare(&model, &questions, limit, threads)?;
        }
    }

    #[test]
    fn rows_of_parts(model in growing_model(), limits in prop::collection::vec((limits(), 1..5_usize), 4)) {
        for (limit, threads) in limits {
            let exploration = explore(&model, &limit.options(threads), &mut limit.watch(), None);
            check_rows(&model, &exploration)?;
        }
    }
}

proptest! {
    #![proptest_config(nets(60))]

    #[test]
    fn examinations_of_parts(model in growing_model(), (limit, threads) in (limits(), 1..5_usize)) {
        let one = |examination: Examination| (examination.question(), definition(examination, &model));
        compare(&model, &Examination::ALL.map(one), limit, threads)?;
    }
}

fn counted(place: usize, comparison: Comparison, n: i128) -> Bound {
    Bound::Compare(comparison, Term::Tokens(PlaceId::at(place)), Term::Number(n))
}

#[test]
fn a_counter_does_not_fall_back_at_the_limit() {
    // Three tokens fit into the digit of `p`; the fourth would be carried away.
    let model =
        Model { initial: vec![1, 0], transitions: vec![Arcs { pre: vec![(0, 1)], post: vec![(0, 1), (1, 1)] }] };
    let few = always(possibly(counted(1, Comparison::AtMost, 3)));
    for threads in 1..=4 {
        for states in [1, 2, 3, 4, 5, 7, 8, 15, 16, 100] {
            compare(&model, &questions(vec![few.clone()]), Limit::States(states), threads).unwrap();
        }
    }
}

#[test]
fn three_sources_do_not_carry_into_each_other() {
    let source = |place| Arcs { pre: vec![], post: vec![(place, 1)] };
    let model = Model { initial: vec![0, 0, 0], transitions: vec![source(0), source(1), source(2)] };
    let formulas: Vec<Bound> = (0..3)
        .flat_map(|place| {
            let empty = counted(place, Comparison::Equal, 0);
            let next = |f| Bound::Next(Quantifier::Some, Box::new(f));
            [always(possibly(empty.clone())), next(always(possibly(empty.clone()))), next(possibly(next(empty)))]
        })
        .collect();
    for threads in 1..=4 {
        for states in [1, 2, 3, 4, 10, 20] {
            compare(&model, &questions(formulas.clone()), Limit::States(states), threads).unwrap();
        }
    }
}

/// A counter raised in one of many modes, chosen at the beginning: all modes come to the end of a digit at one distance.
fn in_modes(modes: u32) -> Model {
    let mut model = Model { initial: vec![0; modes as usize + 2], transitions: Vec::new() };
    model.initial[0] = 1;
    for mode in 0..modes {
        let place = 2 + mode;
        model.transitions.push(Arcs { pre: vec![(0, 1)], post: vec![(place, 1)] });
        model.transitions.push(Arcs { pre: vec![(place, 1)], post: vec![(place, 1), (1, 1)] });
    }
    model
}

#[test]
fn counting_in_many_modes_never_begins_again() {
    // As many modes as bring the end of a digit to the first look at the limit of states.
    let model = in_modes(393);
    let net = net_of(&model);
    let empty = always(possibly(counted(1, Comparison::Equal, 0)));
    let formulas = [empty.clone(), Bound::Next(Quantifier::Some, Box::new(empty))];
    for threads in [1, 2, 3] {
        let budget = Budget { states: 100_000, ..Budget::default() };
        let options = Options { budget, threads, ..Options::default() };
        let questions: Vec<Question> = formulas.iter().cloned().map(Question::Holds).collect();
        let report = judge(&net, &questions, &options, &mut |_| None);
        assert!(report.figures.states > 100_000, "{:?}", report.stop);
        for reply in &report.replies {
            assert!(matches!(reply, Reply::Unknown(reason) if reason.contains("limit")), "{reply:?}");
        }
    }
}

#[test]
fn rows_of_wide_levels_are_those_of_the_states_expanded() {
    // Levels of more than 4096 states, which all threads expand together, ended at any moment.
    let source = |place| Arcs { pre: vec![], post: vec![(place, 1)] };
    let model = Model { initial: vec![0; 5], transitions: (0..5).map(source).collect() };
    for threads in 1..=4 {
        let options = Limit::States(21_000 + 300 * threads as u64).options(threads);
        let exploration = explore(&model, &options, &mut |_| None, None);
        let (kept, expanded) = (exploration.kept(), exploration.expanded());
        assert!(kept > 21_000 && expanded < kept, "{expanded} of {kept}");
        check_rows(&model, &exploration).unwrap();
    }
}

#[test]
fn states_that_tables_have_no_room_for_are_left_out() {
    // Markings of one word, and of several.
    let source = |place| Arcs { pre: vec![], post: vec![(place, 1)] };
    let mut model = Model { initial: vec![0; 4], transitions: (0..4).map(source).collect() };
    for (wide, bytes) in [(false, 2_700_000), (true, 6_000_000)] {
        if wide {
            model.initial.extend([1 << 40, 1 << 40]);
            model.transitions.push(Arcs { pre: vec![(4, 1)], post: vec![(5, 1)] });
        }
        for threads in [1, 2, 4] {
            let budget = Budget { bytes, ..Budget::default() };
            let exploration = explore(&model, &Options { budget, threads, keep: true }, &mut |_| None, None);
            assert_eq!(exploration.stop, Stop::Bytes(bytes));
            let figures = &exploration.figures;
            assert!(figures.states > 30_000 && figures.bytes < bytes / 2 * 3, "{figures:?}");
            check_rows(&model, &exploration).unwrap();
        }
    }
}

/// Remembers the first marking with many tokens, as long as it is to be kept.
#[derive(Default)]
struct Remembering(Mutex<(Option<Marking>, usize)>);

impl Wanted for Remembering {
    fn is(&self, view: &View<'_>) -> bool {
        let mut known = self.0.lock().unwrap();
        if known.0.is_none() && view.tokens(0) >= 2 {
            known.0 = Some(view.marking());
        }
        false
    }

    fn forget(&self) {
        let mut known = self.0.lock().unwrap();
        *known = (None, known.1 + 1);
    }
}

#[test]
fn a_search_that_begins_again_forgets_what_it_will_not_keep() {
    let grow = |by| Arcs { pre: vec![], post: vec![(0, by)] };
    let model = Model { initial: vec![0], transitions: vec![grow(1), grow(1 << 20), grow(1 << 40)] };
    for threads in 1..=4 {
        for states in [1, 10, 1000] {
            let seen = Remembering::default();
            let options = Limit::States(states).options(threads);
            let exploration = explore(&model, &options, &mut |_| None, Some(&seen));
            let (found, times) = seen.0.into_inner().unwrap();
            assert!(times > 0, "the digit of 1 bit has become larger");
            assert!(states < 1000 || found.is_some());
            assert!(found.is_none_or(|found| exploration.firings(&found).is_some()));
        }
    }
}
