//! A search towards a goal finds a nearest marking that has it, or none, as a search of everything does.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use petril::explore::engine::{Model, Options, explore_towards};
use petril::explore::{Goal, Stop, Tokens, Walk, without_loops};
use proptest::prelude::*;
use support::naive_nets::{Marking, fire, search};
use support::random_model::{any_model, conserving_model, machines};

/// Markings a random net may have.
const MOST: usize = 3000;

/// A marking, and the net whose it is.
struct Plain<'a>(&'a Model, &'a Marking);

impl Tokens for Plain<'_> {
    fn tokens(&self, place: u32) -> u64 {
        self.1[place as usize]
    }

    fn is_enabled(&self, transition: u32) -> bool {
        fire(&self.0.transitions[transition as usize], self.1).is_some()
    }

    fn is_dead(&self) -> bool {
        (0..self.0.transitions.len() as u32).all(|transition| !self.is_enabled(transition))
    }
}

fn goal(places: usize, transitions: usize) -> impl Strategy<Value = Goal> {
    let places = 0..places as u32;
    let terms = prop::collection::btree_map(places, prop_oneof![-2..=-1_i64, 1..=3_i64], 1..=3);
    let at_least =
        (terms, -3..=5_i128).prop_map(|(terms, least)| Goal::AtLeast { terms: terms.into_iter().collect(), least });
    let transition = 0..transitions as u32;
    let atom = prop_oneof![
        4 => at_least,
        2 => transition.clone().prop_map(Goal::Enabled),
        2 => transition.prop_map(Goal::Disabled),
        1 => Just(Goal::Dead),
        1 => Just(Goal::Alive),
    ];
    atom.prop_recursive(3, 8, 3, |part| {
        let parts = prop::collection::vec(part, 1..=3);
        prop_oneof![2 => parts.clone().prop_map(Goal::All), 1 => parts.prop_map(Goal::Any)]
    })
}

/// Nets with a goal.
fn with_goal(model: impl Strategy<Value = Model>) -> impl Strategy<Value = (Model, Goal)> {
    let filtered = model.prop_filter("a goal may speak of transitions", |model| !model.transitions.is_empty());
    filtered.prop_flat_map(|model| {
        let goal = goal(model.initial.len(), model.transitions.len());
        (Just(model), goal)
    })
}

fn agree(model: &Model, goal: &Goal) -> Result<(), TestCaseError> {
    let Some(naive) = search(model, MOST) else { return Ok(()) };
    let nearest = naive.nearest(|marking| goal.holds(&Plain(model, marking)));
    for threads in [1, 2] {
        let options = Options { threads, keep: true, ..Options::default() };
        let exploration = explore_towards(model, &options, &mut |_| None, goal);
        let found = exploration.found.as_ref();
        prop_assert_eq!(found.map(|found| naive.markings[found]), nearest);
        prop_assert!(exploration.figures.states <= naive.markings.len() as u64);
        let Some(found) = found else {
            prop_assert_eq!(&exploration.stop, &Stop::Complete);
            continue;
        };
        prop_assert!(goal.holds(&Plain(model, found)));
        let firings = exploration.firings(found).unwrap();
        prop_assert_eq!(Some(firings.len()), nearest);
        let step = |marking: Marking, &transition: &usize| fire(&model.transitions[transition], &marking).unwrap();
        prop_assert_eq!(&firings.iter().fold(model.initial.clone(), step), found);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn any_net((model, goal) in with_goal(any_model())) {
        agree(&model, &goal)?;
    }

    #[test]
    fn nets_that_conserve_tokens((model, goal) in with_goal(conserving_model())) {
        agree(&model, &goal)?;
    }

    #[test]
    fn small_machines((model, goal) in with_goal(machines(5, 4, 8))) {
        agree(&model, &goal)?;
    }

    #[test]
    fn many_machines((model, goal) in with_goal(machines(150, 3, 8))) {
        agree(&model, &goal)?;
    }
}

proptest! {
    #[test]
    fn walks_fire_what_is_enabled((model, goal) in with_goal(machines(40, 4, 60)), seed in 1..100_u64) {
        let Some(mut walk) = Walk::new(&model, seed) else { return Ok(()) };
        for step in 0..1000 {
            let before = walk.firings().len();
            let fired = if step % 3 == 0 { walk.step() } else { walk.step_towards(&goal) };
            prop_assert_eq!(walk.firings().len(), before + usize::from(fired));
            if step == 300 || !fired {
                walk.restart();
            }
        }
        let step = |marking: Marking, &transition: &u32| {
            fire(&model.transitions[transition as usize], &marking).unwrap()
        };
        let firings = walk.firings();
        let last = firings.iter().fold(model.initial.clone(), step);
        prop_assert!((0..last.len()).all(|place| walk.tokens(place as u32) == last[place]));
        prop_assert_eq!(goal.holds(&walk), goal.holds(&Plain(&model, &last)));
        // No marking twice, and the same at the end.
        let short = without_loops(&model, firings);
        let mut markings = vec![model.initial.clone()];
        short.iter().for_each(|transition| markings.push(step(markings[markings.len() - 1].clone(), transition)));
        prop_assert_eq!(&markings[markings.len() - 1], &last);
        markings.sort();
        prop_assert!(markings.windows(2).all(|pair| pair[0] != pair[1]));
    }
}

/// `count` switches that can be turned on one by one, and a last one that needs the first.
fn switches(count: u32) -> Model {
    let mut model = Model::default();
    for switch in 0..count {
        model.initial.extend([1, 0]);
        let arcs = |from, to| petril::explore::engine::Arcs { pre: vec![(from, 1)], post: vec![(to, 1)] };
        model.transitions.push(arcs(2 * switch, 2 * switch + 1));
    }
    model.transitions[count as usize - 1].pre.push((1, 1));
    model.transitions[count as usize - 1].post.push((1, 1));
    model
}

#[test]
fn what_does_not_help_is_not_fired() {
    // Of 2^20 markings only the way over the first switch leads to the last one.
    let on = |switch: u32| Goal::AtLeast { terms: vec![(2 * switch + 1, 1)], least: 1 };
    let options = Options { keep: true, ..Options::default() };
    let exploration = explore_towards(&switches(20), &options, &mut |_| None, &on(19));
    let found = exploration.found.clone().unwrap();
    assert_eq!(exploration.firings(&found), Some(vec![0, 19]));
    assert_eq!(exploration.figures.states, 3);
    // A dead marking has all switches on; the order does not matter.
    let exploration = explore_towards(&switches(20), &options, &mut |_| None, &Goal::Dead);
    assert_eq!(exploration.figures.states, 21);
    // Both of a pair of places are never marked. No switch but the one in question is turned.
    let both = Goal::All(vec![on(3), Goal::AtLeast { terms: vec![(6, 1)], least: 1 }]);
    let exploration = explore_towards(&switches(20), &options, &mut |_| None, &both);
    assert_eq!((exploration.found, exploration.stop, exploration.figures.states), (None, Stop::Complete, 2));
}
