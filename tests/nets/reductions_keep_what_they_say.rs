//! Random nets and their reductions, both explored without any art: what a property of each kind can see is the same, and
//! what is lifted is a run of the original. Any choice of rules will do, so a failure shrinks to the rule that errs.
//! `PROPTEST_CASES=100000` for a long run.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use petril::net::{Net, PlaceId, Tokens, TransitionId};
use petril::structure::reduce::{Keep, Options, Property, Reduced, Rule, reduce, reduce_with};
use proptest::prelude::*;
use proptest::sample::subsequence;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use support::random_net::{any_net, safe_net, weighted_net};
use support::refined_net::refined_net;

/// Markings a random net may have.
const MOST: usize = 600;

/// Reachable markings, each with a shortest run.
struct Reached {
    runs: BTreeMap<Tokens, Vec<TransitionId>>,
    is_all: bool,
}

fn enabled(net: &Net, tokens: &Tokens) -> Vec<TransitionId> {
    net.transition_ids().filter(|&id| net.has_concession(tokens, id)).collect()
}

fn after(net: &Net, tokens: &Tokens, id: TransitionId) -> Tokens {
    let mut next = tokens.clone();
    net.play(&mut next, id).unwrap();
    next
}

fn reach(net: &Net) -> Reached {
    let mut runs = BTreeMap::from([(net.initial_tokens(), Vec::new())]);
    let mut waiting = VecDeque::from([net.initial_tokens()]);
    while let Some(from) = waiting.pop_front() {
        for id in enabled(net, &from) {
            let to = after(net, &from, id);
            if !runs.contains_key(&to) {
                runs.insert(to.clone(), [&runs[&from][..], &[id]].concat());
                waiting.push_back(to);
            }
        }
        if runs.len() > MOST {
            return Reached { runs, is_all: false };
        }
    }
    Reached { runs, is_all: true }
}

/// What a property sees of a marking: tokens of kept places, and which kept transitions are enabled.
type Sight = (Vec<u64>, Vec<bool>);

fn sight(net: &Net, keep: &Keep, tokens: &Tokens) -> Sight {
    let places = keep.places.iter().map(|&place| tokens.on(place)).collect();
    (places, keep.transitions.iter().map(|&id| net.has_concession(tokens, id)).collect())
}

fn sight_reduced(net: &Net, keep: &Keep, reduced: &Reduced<'_>, tokens: &Tokens) -> Sight {
    let on = |place: PlaceId| tokens.on(reduced.place(place).unwrap());
    let is_enabled = |&id: &TransitionId| {
        let by_preset = net.pre(id).all(|(place, weight)| on(place) >= weight);
        if let Some(id) = reduced.transition(id) {
            assert_eq!(by_preset, reduced.net.has_concession(tokens, id));
        }
        by_preset
    };
    (keep.places.iter().map(|&place| on(place)).collect(), keep.transitions.iter().map(is_enabled).collect())
}

/// A net, its markings, and what is seen of them.
type Watched<'a> = (&'a Net, &'a Reached, &'a dyn Fn(&Tokens) -> Sight);

/// Whether two nets are bisimilar, where one sees so much of each marking, and whether it is dead.
fn are_bisimilar(nets: [Watched<'_>; 2]) -> bool {
    let mut states: BTreeMap<(usize, &Tokens), usize> = BTreeMap::new();
    let mut classes: BTreeMap<(Sight, bool), usize> = BTreeMap::new();
    for (which, (net, reached, sight)) in nets.iter().enumerate() {
        for tokens in reached.runs.keys() {
            let next = classes.len();
            let seen = (sight(tokens), enabled(net, tokens).is_empty());
            states.insert((which, tokens), *classes.entry(seen).or_insert(next));
        }
    }
    let mut count = classes.len();
    loop {
        let mut classes: BTreeMap<(usize, BTreeSet<usize>), usize> = BTreeMap::new();
        let refined = states.iter().map(|(&(which, tokens), &class)| {
            let net = nets[which].0;
            let next = enabled(net, tokens).into_iter().map(|id| after(net, tokens, id));
            let next = next.map(|to| states[&(which, nets[which].1.runs.get_key_value(&to).unwrap().0)]).collect();
            let number = classes.len();
            ((which, tokens), *classes.entry((class, next)).or_insert(number))
        });
        states = refined.collect();
        if classes.len() == count {
            let [one, two] = [0, 1].map(|which| states[&(which, &nets[which].0.initial_tokens())]);
            return one == two;
        }
        count = classes.len();
    }
}

fn check(net: &Net, keep: &Keep, rules: &[Rule]) -> Result<(), TestCaseError> {
    let reduced = reduce_with(net, keep, &Options { rules: rules.to_vec(), ..Options::default() });
    let (before, after) = (reach(net), reach(&reduced.net));
    let at_first = |tokens: &Tokens| sight(net, keep, tokens);
    let at_last = |tokens: &Tokens| sight_reduced(net, keep, &reduced, tokens);
    for (tokens, run) in after.runs.iter().step_by(after.runs.len() / 100 + 1) {
        let lifted = reduced.lift(run).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let mut end = net.initial_tokens();
        for id in lifted {
            prop_assert!(net.has_concession(&end, id));
            net.play(&mut end, id).unwrap();
        }
        prop_assert_eq!(at_first(&end), at_last(tokens));
        if keep.property != Property::Reachability && enabled(&reduced.net, tokens).is_empty() {
            prop_assert!(enabled(net, &end).is_empty());
        }
    }
    if !before.is_all {
        return Ok(());
    }
    prop_assert!(after.is_all && after.runs.len() <= before.runs.len());
    let all_before: BTreeSet<Sight> = before.runs.keys().map(at_first).collect();
    let all_after: BTreeSet<Sight> = after.runs.keys().map(at_last).collect();
    prop_assert_eq!(all_before, all_after);
    if keep.property != Property::Reachability {
        let dead = |net: &Net, tokens: &&Tokens| enabled(net, tokens).is_empty();
        let dead_before: BTreeSet<Sight> = before.runs.keys().filter(|at| dead(net, at)).map(at_first).collect();
        let dead_after: BTreeSet<Sight> = after.runs.keys().filter(|at| dead(&reduced.net, at)).map(at_last).collect();
        prop_assert_eq!(dead_before, dead_after);
    }
    if keep.property == Property::Paths && before.runs.len() <= 100 {
        prop_assert!(are_bisimilar([(net, &before, &at_first), (&reduced.net, &after, &at_last)]));
    }
    Ok(())
}

/// All rules, one, or some.
fn rules() -> impl Strategy<Value = Vec<Rule>> {
    let all = Rule::ALL.to_vec();
    prop_oneof![4 => Just(all.clone()), 2 => subsequence(all.clone(), 1), 3 => subsequence(all, 2..=Rule::ALL.len())]
}

/// A net with what to keep of it.
fn kept(net: impl Strategy<Value = Net>) -> impl Strategy<Value = (Net, Keep)> {
    net.prop_flat_map(move |net| {
        let places: Vec<PlaceId> = net.place_ids().collect();
        let transitions: Vec<TransitionId> = net.transition_ids().collect();
        let (most, few) = (places.len().min(3), transitions.len().min(1));
        let kinds = proptest::sample::select(vec![Property::Reachability, Property::Deadlock, Property::Paths]);
        let places = prop_oneof![subsequence(places.clone(), 0..=most), subsequence(places, 1)];
        let transitions = prop_oneof![2 => Just(Vec::new()), 1 => subsequence(transitions, few)];
        let keep = (kinds, places, transitions);
        keep.prop_map(move |(property, places, transitions)| (net.clone(), Keep { property, places, transitions }))
    })
}

/// Otherwise what the other tests say would be worth little.
#[test]
fn the_random_nets_have_what_each_rule_needs() {
    let mut runner = TestRunner::deterministic();
    let mut applied: BTreeMap<Rule, usize> = BTreeMap::new();
    for _ in 0..1000 {
        let (net, keep) = kept(refined_net()).new_tree(&mut runner).unwrap().current();
        for (rule, times) in reduce(&net, &keep).applied {
            *applied.entry(rule).or_default() += times;
        }
    }
    let rare: Vec<Rule> =
        Rule::ALL.into_iter().filter(|rule| applied.get(rule).is_none_or(|&times| times < 10)).collect();
    assert!(rare.is_empty(), "{applied:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { max_shrink_iters: 20_000, ..ProptestConfig::default() })]

    #[test]
    fn nets_with_weights((net, keep) in kept(weighted_net()), rules in rules()) {
        check(&net, &keep, &rules)?;
    }

    #[test]
    fn refined_nets((net, keep) in kept(refined_net()), rules in rules()) {
        check(&net, &keep, &rules)?;
    }

    #[test]
    fn safe_nets((net, keep) in kept(safe_net()), rules in rules()) {
        check(&net, &keep, &rules)?;
    }

    #[test]
    fn any_nets((net, keep) in kept(any_net()), rules in rules()) {
        check(&net, &keep, &rules)?;
    }
}
