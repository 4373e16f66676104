//! The engine's figures, traces and graphs are those of a search without any art, for nets of every kind it treats specially.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;
use std::sync::atomic::AtomicBool;

use petril::explore::engine::{Arcs, Exploration, Model, Options, explore};
use petril::explore::{Budget, Stop};
use proptest::prelude::*;
use support::naive_nets::{Marking, Naive, fire, search};
use support::random_model::{any_model, conserving_model, machines};

/// Markings a random net may have.
const MOST: usize = 3000;

fn options(threads: usize) -> Options {
    Options { threads, keep: true, ..Options::default() }
}

fn all(model: &Model, options: &Options) -> Exploration {
    explore(model, options, &mut |_| None, None)
}

/// Checks everything the engine says about a net that was explored completely.
fn check(model: &Model, naive: &Naive, exploration: &Exploration) -> Result<(), TestCaseError> {
    let figures = &exploration.figures;
    prop_assert_eq!(&exploration.stop, &Stop::Complete);
    prop_assert_eq!(figures.states, naive.markings.len() as u64);
    prop_assert_eq!(figures.expanded, figures.states);
    prop_assert_eq!(figures.transitions, naive.steps.len() as u64);
    prop_assert_eq!(figures.depth, *naive.markings.values().max().unwrap());
    let maxima: Vec<u64> = (0..model.initial.len())
        .map(|place| naive.markings.keys().map(|marking| marking[place]).max().unwrap())
        .collect();
    prop_assert_eq!(figures.max_tokens_in_place, maxima.iter().copied().max().unwrap());
    prop_assert_eq!(&figures.place_maxima, &maxima);
    let total = naive.markings.keys().map(|marking| marking.iter().sum()).max();
    prop_assert_eq!(Some(figures.max_tokens_in_marking), total);
    let enabled: BTreeSet<usize> = naive.steps.iter().map(|&(_, transition, _)| transition).collect();
    let never: Vec<usize> = (0..model.transitions.len()).filter(|transition| !enabled.contains(transition)).collect();
    prop_assert_eq!(&figures.never_enabled, &never);
    let deadlocks = naive.deadlocks();
    prop_assert_eq!(figures.deadlocks, deadlocks.len() as u64);
    let nearest = naive.nearest(|marking| deadlocks.contains(&marking));
    let found = figures.deadlock.as_ref().map(|marking| naive.markings[marking]);
    prop_assert_eq!(found, nearest);
    for (marking, &distance) in naive.markings.iter().step_by(naive.markings.len() / 20 + 1) {
        let firings = exploration.firings(marking).unwrap();
        prop_assert_eq!(firings.len(), distance);
        prop_assert_eq!(&replay(model, &firings), marking);
    }
    check_graph(naive, exploration, model)
}

/// The marking after some firings, each of which must be possible.
fn replay(model: &Model, firings: &[usize]) -> Marking {
    let step = |marking: Marking, &transition: &usize| fire(&model.transitions[transition], &marking).unwrap();
    firings.iter().fold(model.initial.clone(), step)
}

fn check_graph(naive: &Naive, exploration: &Exploration, model: &Model) -> Result<(), TestCaseError> {
    let mut markings: Vec<Marking> = Vec::new();
    exploration.for_each_state(|id, view| {
        assert_eq!(id as usize, markings.len());
        markings.push((0..model.initial.len()).map(|place| view.tokens(place)).collect());
        let enabled = |transition: &usize| fire(&model.transitions[*transition], &markings[id as usize]).is_some();
        let transitions: Vec<usize> = (0..model.transitions.len()).filter(enabled).collect();
        assert_eq!(view.enabled().collect::<Vec<usize>>(), transitions);
        assert_eq!(view.is_deadlock(), transitions.is_empty());
    });
    prop_assert_eq!(&markings[0], &model.initial);
    prop_assert!(markings.windows(2).all(|pair| naive.markings[&pair[0]] <= naive.markings[&pair[1]]));
    let steps = exploration.steps(&AtomicBool::new(false)).unwrap();
    prop_assert_eq!(steps.rows(), markings.len());
    let mut found = BTreeSet::new();
    exploration.for_each_state(|id, view| {
        for (&target, fired) in steps.successors(id).iter().zip(view.enabled()) {
            found.insert((markings[id as usize].clone(), fired, markings[target as usize].clone()));
        }
    });
    prop_assert_eq!(&found, &naive.steps);
    Ok(())
}

fn agree(model: &Model) -> Result<(), TestCaseError> {
    if let Some(naive) = search(model, MOST) {
        for threads in [1, 2, 3] {
            check(model, &naive, &all(model, &options(threads)))?;
        }
        for place in 0..model.initial.len().min(8) {
            for tokens in 1..=2 {
                let wanted = |view: &petril::explore::engine::View<'_>| view.tokens(place) >= tokens;
                let exploration = explore(model, &options(1), &mut |_| None, Some(&wanted));
                let nearest = naive.nearest(|marking| marking[place] >= tokens);
                prop_assert_eq!(exploration.found.as_ref().map(|found| naive.markings[found]), nearest);
                if let Some(found) = &exploration.found {
                    let firings = exploration.firings(found).unwrap();
                    prop_assert_eq!(Some(firings.len()), nearest);
                    prop_assert!(replay(model, &firings)[place] >= tokens);
                }
            }
        }
    } else {
        let budget = Budget { states: 1000, ..Budget::default() };
        let exploration = all(model, &Options { budget, ..options(1) });
        prop_assert_eq!(exploration.stop, Stop::States(1000));
        prop_assert!(exploration.figures.states > 1000);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn any_net(model in any_model()) {
        agree(&model)?;
    }

    #[test]
    fn nets_that_conserve_tokens(model in conserving_model()) {
        agree(&model)?;
    }

    #[test]
    fn small_machines(model in machines(5, 4, 8)) {
        agree(&model)?;
    }

    #[test]
    fn machines_of_many_states(model in machines(20, 300, 12)) {
        agree(&model)?;
    }

    #[test]
    fn many_machines(model in machines(150, 3, 8)) {
        agree(&model)?;
    }
}

/// `count` rings of four places; with the first one, as many pairs of places flip to and fro.
fn rings(count: u32, pairs: u32) -> Model {
    let mut model = Model::default();
    for ring in 0..count {
        model.initial.extend([1, 0, 0, 0]);
        for step in 0..4 {
            model
                .transitions
                .push(Arcs { pre: vec![(4 * ring + step, 1)], post: vec![(4 * ring + (step + 1) % 4, 1)] });
        }
    }
    for pair in 0..pairs {
        let place = model.initial.len() as u32;
        model.initial.extend([1, 0]);
        let (there, back) = if pair % 2 == 0 { (0, 2) } else { (1, 3) };
        model.transitions[there].pre.push((place, 1));
        model.transitions[there].post.push((place + 1, 1));
        model.transitions[back].pre.push((place + 1, 1));
        model.transitions[back].post.push((place, 1));
    }
    model
}

#[test]
fn threads_share_large_nets() {
    // 4^8 states, of which each enables one transition for each ring; a state that is k steps away in each ring is the farthest.
    for pairs in [0, 70] {
        for threads in [1, 2, 3] {
            let exploration = all(&rings(8, pairs), &options(threads));
            let figures = &exploration.figures;
            assert_eq!((figures.states, figures.transitions), (65_536, 8 * 65_536));
            assert_eq!((figures.deadlocks, figures.depth), (0, 24));
            assert_eq!((figures.max_tokens_in_place, figures.max_tokens_in_marking), (1, 8 + u64::from(pairs)));
            let steps = exploration.steps(&AtomicBool::new(false)).unwrap();
            assert_eq!(steps.rows(), 65_536);
            assert!((0..65_536).all(|state| steps.successors(state).len() == 8));
            let mut last = vec![0; 32 + 2 * pairs as usize];
            (0..8).for_each(|ring| last[4 * ring + 3] = 1);
            (0..pairs as usize).for_each(|pair| last[32 + 2 * pair + pair % 2] = 1);
            assert_eq!(exploration.firings(&last).map(|firings| firings.len()), Some(24), "{pairs} {threads}");
        }
    }
}

#[test]
fn nets_have_many_transitions() {
    // A ring of 5000 places and one of four, which do not know of each other.
    let mut model = rings(1, 0);
    for place in 0..5000 {
        model.initial.push(u64::from(place == 0));
        model.transitions.push(Arcs { pre: vec![(4 + place, 1)], post: vec![(4 + (place + 1) % 5000, 1)] });
    }
    for threads in [1, 2] {
        let exploration = all(&model, &options(threads));
        let figures = &exploration.figures;
        assert_eq!((figures.states, figures.transitions, figures.depth), (20_000, 40_000, 4999 + 3));
        assert_eq!((figures.bits, figures.max_tokens_in_marking), (2 + 13, 2));
        assert!(figures.never_enabled.is_empty());
    }
}

#[test]
fn a_counter_without_end_is_stopped() {
    let model = Model { initial: vec![0], transitions: vec![Arcs { pre: vec![], post: vec![(0, 1)] }] };
    let budget = Budget { states: 100_000, ..Budget::default() };
    let exploration = all(&model, &Options { budget, ..options(1) });
    assert_eq!(exploration.stop, Stop::States(100_000));
    // A state for each number from 0, all but the last expanded.
    assert_eq!(exploration.figures.max_tokens_in_place, exploration.figures.expanded - 1);
    let model = Model { initial: vec![1], transitions: vec![Arcs { pre: vec![(0, 1)], post: vec![(0, 1 << 61)] }] };
    assert!(matches!(all(&model, &options(1)).stop, Stop::Refused(_)));
}

#[test]
fn whoever_watches_can_stop() {
    let stop = |progress: &petril::explore::Progress| (progress.states > 10_000).then(|| "enough".to_owned());
    for threads in [1, 2] {
        let exploration = explore(&rings(8, 0), &options(threads), &mut { stop }, None);
        assert_eq!(exploration.stop, Stop::Watcher("enough".to_owned()));
        assert!(exploration.figures.states > 10_000 && exploration.figures.states < 65_536);
        // Only states that were expanded have rows, whole ones.
        let steps = exploration.steps(&AtomicBool::new(false)).unwrap();
        let states = exploration.figures.states as u32;
        assert_eq!(steps.rows() as u64, exploration.figures.expanded);
        assert!(steps.rows() < states as usize);
        assert!((0..steps.rows() as u32).all(|state| steps.successors(state).len() == 8));
        assert!((0..steps.rows() as u32).all(|state| steps.successors(state).iter().all(|&next| next <= states)));
        assert!(exploration.steps(&AtomicBool::new(true)).is_none());
    }
}

#[test]
fn empty_nets_have_one_state() {
    for model in [Model::default(), Model { initial: vec![7], transitions: vec![] }] {
        let exploration = all(&model, &options(1));
        assert_eq!((exploration.figures.states, exploration.figures.deadlocks), (1, 1));
        assert_eq!(exploration.figures.deadlock, Some(model.initial.clone()));
    }
}
