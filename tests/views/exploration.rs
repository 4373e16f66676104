//! The search finds what a search without any art finds, keeps its limits, and does not depend on the number of threads.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::atomic::AtomicBool;

use petril::explore::engine::{self, Model, Options};
use petril::explore::{Budget, Failure, Graph, Markings, ScanSpace, Stop, explore};
use petril::net::{Net, TransitionId};
use proptest::prelude::*;
use support::random_net::{any_net, safe_net};
use support::systems::{HANDS, TWO_HAND_SWITCH, system};

/// A marking as the tokens of each place.
type Tokens = Vec<u8>;

/// All markings of a net by its token game, with the transitions each enables. A net that is not safe ends the search.
#[derive(Debug, Default)]
struct Naive {
    /// For each marking, its distance from the initial one.
    markings: BTreeMap<Tokens, usize>,
    firings: Vec<(Tokens, usize, Tokens)>,
    is_safe: bool,
}

fn tokens(net: &Net) -> Tokens {
    net.places().map(|place| u8::from(place.is_marked())).collect()
}

/// Fires a transition; `None` if it is not enabled.
fn fire(net: &Net, from: &Tokens, transition: usize) -> Option<Tokens> {
    let arcs = net.arcs(TransitionId::at(transition));
    let mut to = from.clone();
    for place in arcs.preset() {
        to[place.index()] = to[place.index()].checked_sub(1)?;
    }
    arcs.produce.iter().chain(arcs.read).for_each(|place| to[place.index()] += 1);
    Some(to)
}

fn naive(net: &Net) -> Naive {
    let mut found = Naive { is_safe: true, ..Naive::default() };
    let mut queue = VecDeque::from([(tokens(net), 0)]);
    found.markings.insert(tokens(net), 0);
    while let Some((from, distance)) = queue.pop_front() {
        for transition in 0..net.transitions().len() {
            let Some(to) = fire(net, &from, transition) else { continue };
            if to.iter().any(|&tokens| tokens > 1) {
                found.is_safe = false;
                continue;
            }
            if !found.markings.contains_key(&to) {
                found.markings.insert(to.clone(), distance + 1);
                queue.push_back((to.clone(), distance + 1));
            }
            found.firings.push((from.clone(), transition, to));
        }
    }
    found
}

fn all(net: &Net) -> Markings<'_> {
    Markings::explored(net, Budget::default(), &mut |_| None)
}

/// A state of the graph in terms of tokens.
fn unpacked(markings: &Markings<'_>, id: u32) -> Tokens {
    let state = markings.graph().state(id);
    markings.net().place_ids().map(|place| u8::from(markings.is_marked(state, place))).collect()
}

fn sorted<T: Ord>(items: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut items: Vec<T> = items.into_iter().collect();
    items.sort();
    items
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_graph_is_that_of_the_naive_search(net in prop_oneof![safe_net(), any_net()]) {
        let expected = naive(&net);
        let markings = all(&net);
        let graph = markings.graph();
        let marking = |id| unpacked(&markings, id);
        prop_assert_eq!(graph.is_complete(), expected.is_safe);
        prop_assert_eq!(graph.failures().is_empty(), expected.is_safe);
        let found: BTreeMap<Tokens, usize> = graph.ids().map(|id| (marking(id), graph.path_to(id).len() - 1)).collect();
        prop_assert_eq!(graph.len(), found.len(), "every state once");
        prop_assert_eq!(&found, &expected.markings);
        prop_assert_eq!(graph.depth(), expected.markings.values().copied().max().unwrap_or(0));
        let steps = graph.ids().flat_map(|id| graph.successors(id).iter().map(move |&to| (id, to)));
        let steps = sorted(steps.map(|(from, to)| (marking(from), marking(to))));
        prop_assert_eq!(graph.steps(), steps.len() as u64);
        prop_assert_eq!(steps, sorted(expected.firings.iter().map(|(from, _, to)| (from.clone(), to.clone()))));
    }

    #[test]
    fn numbers_rise_with_the_distance_and_rows_run_both_ways(net in safe_net()) {
        let markings = all(&net);
        let graph = markings.graph();
        prop_assert_eq!(graph.initial(), &[0]);
        let distances: Vec<usize> = graph.ids().map(|id| graph.path_to(id).len()).collect();
        prop_assert!(distances.is_sorted());
        for id in graph.ids() {
            for pair in graph.path_to(id).windows(2) {
                prop_assert!(graph.successors(pair[0]).contains(&pair[1]));
            }
        }
        let forward = graph.ids().flat_map(|id| graph.successors(id).iter().map(move |&to| (id, to)));
        let backward = graph.ids().flat_map(|id| {
            let rows = graph.rows_to(id).iter();
            rows.flat_map(|&row| graph.members(row)).map(move |&from| (from, id)).collect::<Vec<_>>()
        });
        prop_assert_eq!(sorted(forward), sorted(backward));
        prop_assert!(graph.open().is_clear());
    }

    #[test]
    fn behaviour_is_that_of_the_definition(net in safe_net()) {
        let expected = naive(&net);
        let transitions: BTreeSet<usize> = expected.firings.iter().map(|firing| firing.1).collect();
        let dead: Vec<TransitionId> = net.transition_ids().filter(|id| !transitions.contains(&id.index())).collect();
        let is_dead = |marking: &&Tokens| expected.firings.iter().all(|(from, ..)| from != *marking);
        let deadlocks = expected.markings.keys().filter(is_dead).count() as u64;
        // Live: from every marking, every transition that is not dead can fire again, now or later.
        let live = expected.markings.keys().all(|marking| {
            let mut reached = BTreeSet::from([marking.clone()]);
            let mut fired = BTreeSet::new();
            while let Some((_, transition, to)) = (expected.firings.iter())
                .find(|(from, transition, to)| reached.contains(from) && (!fired.contains(transition) || !reached.contains(to)))
            {
                fired.insert(*transition);
                reached.insert(to.clone());
            }
            fired == transitions
        });
        let options = Options { keep: true, ..Options::default() };
        let found = engine::explore(&Model::from(&net), &options, &mut |_| None, None).behaviour(&AtomicBool::new(false)).unwrap();
        prop_assert_eq!((found.deadlocks, found.dead, found.live_without_dead), (deadlocks, dead, live));
    }

    /// Every part of a graph is the beginning of the whole.
    #[test]
    fn a_limit_cuts_and_changes_nothing(net in safe_net(), limit in 1..40_u64) {
        let budget = Budget { states: limit, ..Budget::default() };
        let (whole, part) = (all(&net), Markings::explored(&net, budget, &mut |_| None));
        let (whole, part) = (whole.graph(), part.graph());
        prop_assert!(part.len() <= whole.len());
        for id in part.ids() {
            prop_assert_eq!(part.state(id), whole.state(id));
            let known = part.successors(id);
            prop_assert!(known.is_empty() || known == whole.successors(id));
        }
        let expanded: Vec<usize> = (0..part.expanded()).collect();
        prop_assert_eq!((0..part.len()).filter(|&id| !part.open().contains(id)).collect::<Vec<_>>(), expanded);
        prop_assert_eq!(part.is_complete(), part.expanded() == whole.len());
    }
}

#[test]
fn the_number_of_threads_does_not_show() {
    let system = system(TWO_HAND_SWITCH, &[HANDS]);
    let space = ScanSpace::new(&system);
    let listed = |graph: &Graph| {
        let state = |id| (graph.state(id).to_vec(), graph.successors(id).to_vec(), graph.path_to(id));
        graph.ids().map(state).collect::<Vec<_>>()
    };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let scans = || listed(&explore(&space, Budget::default(), &mut |_| None));
        pool.install(|| (scans(), listed(all(&system.net).graph())))
    };
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(7));
}

#[test]
fn a_search_ends_for_one_of_four_reasons() {
    let system = system(TWO_HAND_SWITCH, &[HANDS]);
    let run = |budget, watch: &mut dyn FnMut(&petril::explore::Progress) -> Option<String>| {
        Markings::explored(&system.net, budget, watch)
    };
    let whole = Budget::default();

    let complete = run(whole, &mut |_| None);
    let complete = complete.graph();
    assert_eq!((complete.stop(), complete.len(), complete.is_complete()), (&Stop::Complete, 797, true));
    assert_eq!(complete.stop().to_string(), "every state was explored");

    let few = run(Budget { states: 100, ..whole }, &mut |_| None);
    let few = few.graph();
    assert_eq!(few.stop(), &Stop::States(100));
    assert!((100..797).contains(&few.len()) && few.expanded() < few.len() && !few.is_complete());
    assert_eq!(few.stop().to_string(), "the limit of 100 states was reached");
    // Exactly as many as there are is enough.
    assert!(run(Budget { states: 797, ..whole }, &mut |_| None).graph().is_complete());
    assert_eq!(run(Budget { states: 796, ..whole }, &mut |_| None).graph().stop(), &Stop::States(796));

    let small = run(Budget { bytes: 4096, ..whole }, &mut |_| None);
    let small = small.graph();
    assert_eq!(small.stop(), &Stop::Bytes(4096));
    assert!(small.len() < 797 && !small.is_complete());
    assert_eq!(run(Budget { bytes: 3 << 20, ..whole }, &mut |_| None).graph().stop(), &Stop::Complete);
    assert_eq!(Stop::Bytes(3 << 20).to_string(), "the limit of 3 MiB was reached");

    let mut seen = Vec::new();
    let watched = run(whole, &mut |progress| {
        seen.push((progress.states, progress.expanded, progress.depth));
        (progress.depth >= 5).then(|| "enough is enough".to_owned())
    });
    let watched = watched.graph();
    assert_eq!(watched.stop(), &Stop::Watcher("enough is enough".to_owned()));
    assert_eq!(watched.stop().to_string(), "enough is enough");
    assert!(seen.is_sorted() && seen.iter().all(|(states, expanded, _)| expanded <= states), "{seen:?}");
    // It is asked when states at depth 5 have been expanded, so some at depth 6 are known.
    assert_eq!(watched.depth(), 6);
}

/// Seventy inputs are more valuations than anyone can count; whatever the budget says, the search does not begin.
#[test]
fn steps_without_number_are_refused_before_they_are_made() {
    let names: Vec<String> = (0..70).map(|i| format!("i{i}")).collect();
    let text = format!("PROGRAM p VAR_INPUT {} : BOOL; END_VAR\nLD i0\nEND_PROGRAM", names.join(", "));
    let system = system(&text, &[]);
    let space = ScanSpace::new(&system);
    for states in [1000, u64::MAX] {
        let graph = explore(&space, Budget { states, bytes: u64::MAX }, &mut |_| None);
        assert!(graph.is_empty() && !graph.knows_initial() && !graph.is_complete());
        let Stop::Refused(reason) = graph.stop() else { panic!("{:?}", graph.stop()) };
        for part in ["`i0` (2 values)", "66 more", "say with a plant"] {
            assert!(reason.contains(part), "{reason}");
        }
    }
    // Up to 2^24 of them are a matter of the budget.
    let few = format!("PROGRAM p VAR_INPUT {} : BOOL; END_VAR\nLD i0\nEND_PROGRAM", names[..24].join(", "));
    let few = support::systems::system(&few, &[]);
    let graph = explore(&ScanSpace::new(&few), Budget { states: 1000, bytes: u64::MAX }, &mut |_| None);
    assert_eq!(graph.stop(), &Stop::States(1000));
}

#[test]
fn a_second_token_is_a_failure_where_it_falls() {
    let net = petril::exchange::tina::read(&petril::source::Source::new("n", "pl a (1)\ntr t a -> b\ntr u b -> a c\n"))
        .unwrap()
        .net;
    let markings = all(&net);
    let graph = markings.graph();
    // a; b; a c; b c, where u would put a second token on c.
    assert_eq!((graph.len(), graph.stop()), (4, &Stop::Complete));
    let c = net.find_place("c").unwrap();
    assert_eq!(graph.failures(), &[(Some(3), Failure::NotSafe(c).into())]);
    assert!(!graph.is_complete() && graph.open().contains(3));
}
