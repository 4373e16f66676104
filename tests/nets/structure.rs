//! What is said of the structure of nets is what their state spaces and naive textbook versions say, for random nets of all kinds.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::BTreeSet;

use fixedbitset::FixedBitSet;
use petril::explore::engine::Model;
use petril::net::{Builder, Net, PlaceId, TransitionId};
use petril::structure::state_equation::{Bound, Certificate, Constraint, Outcome, Problem, Relation};
use petril::structure::{
    Class, Commoner, Components, Flow, Incidence, Limits, SiphonLimits, Summary, commoner, largest_siphon,
    largest_trap, minimal_siphons, minimal_traps, place_basis, place_invariants, starved, transition_basis,
    transition_invariants,
};
use proptest::prelude::*;
use support::naive_nets::{Marking, Naive, search};
use support::naive_structure::{Matrix, incidence, minimal, rank, semiflows, siphons, transposed, traps};

/// Enough for any net here.
const STEPS: u64 = 10_000_000;

/// A net with weights up to `weight`, bounded or not, with read arcs and loops.
fn net(most_places: usize, most_transitions: usize, weight: u64) -> impl Strategy<Value = Net> {
    (1..=most_places).prop_flat_map(move |places| {
        let side = move || prop::collection::vec((0..places, 1..=weight), 0..=2);
        let transitions = prop::collection::vec((side(), side(), side()), 0..=most_transitions);
        (prop::collection::vec(0..=weight, places), transitions).prop_map(|(initial, transitions)| {
            let mut builder = Builder::new("random");
            for (i, &tokens) in initial.iter().enumerate() {
                builder.place_with(format!("p{i}"), tokens);
            }
            for (i, (take, put, test)) in transitions.iter().enumerate() {
                let [take, put, test] = [take, put, test]
                    .map(|list| list.iter().map(|&(place, weight)| (PlaceId::at(place), weight)).collect::<Vec<_>>());
                // Few transitions read, or hardly any would be enabled.
                let test = if i % 3 == 0 { test } else { Vec::new() };
                builder.weighted(format!("t{i}"), &take, &put, &test);
            }
            builder.build()
        })
    })
}

/// Some markings that can be reached; all of them if they are few.
fn reachable(net: &Net) -> (Vec<Marking>, bool) {
    let model = Model::from(net);
    for most in [2000, 300, 30] {
        if let Some(naive) = search(&model, most) {
            return (naive.markings.into_keys().collect(), true);
        }
    }
    // A walk, where there are too many.
    let mut tokens = net.initial_tokens();
    let mut seen = vec![tokens.as_slice().to_vec()];
    for step in 0..200_usize {
        let enabled: Vec<_> = net.transition_ids().filter(|&id| net.has_concession(&tokens, id)).collect();
        let Some(&id) = enabled.get(step * 7919 % enabled.len().max(1)) else { break };
        net.play(&mut tokens, id).unwrap();
        seen.push(tokens.as_slice().to_vec());
    }
    (seen, false)
}

/// Places with coefficients, a relation by number, a value.
type Raw = (Vec<(usize, i64)>, u8, i64);

fn constraint() -> impl Strategy<Value = Raw> {
    (prop::collection::vec((0..8_usize, -3..=3_i64), 1..=3), 0..3_u8, -2..=6_i64)
}

fn constraints(net: &Net, raw: &[Raw]) -> Vec<Constraint> {
    let made = raw.iter().map(|(terms, relation, value)| Constraint {
        terms: terms.iter().map(|&(place, times)| (PlaceId::at(place % net.places().len()), times)).collect(),
        relation: [Relation::AtLeast, Relation::AtMost, Relation::Equal][usize::from(*relation)],
        value: *value,
    });
    made.collect()
}

fn satisfies(marking: &Marking, constraint: &Constraint) -> bool {
    let sum: i64 = constraint.terms.iter().map(|&(place, times)| times * marking[place.index()] as i64).sum();
    match constraint.relation {
        Relation::AtLeast => sum >= constraint.value,
        Relation::AtMost => sum <= constraint.value,
        Relation::Equal => sum == constraint.value,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn what_is_reachable_is_never_called_unreachable(net in net(6, 7, 3), raw in prop::collection::vec(constraint(), 1..=3)) {
        let constraints = constraints(&net, &raw);
        let (markings, _) = reachable(&net);
        let witness = markings.iter().find(|marking| constraints.iter().all(|one| satisfies(marking, one)));
        match Problem::new(&net).solve(&constraints, STEPS) {
            Outcome::Infeasible(certificate) => {
                prop_assert!(certificate.verify(&net, &constraints));
                prop_assert_eq!(witness, None);
            }
            Outcome::Feasible(firings) => {
                // The answer solves the equation.
                let mut marking: Vec<f64> = net.places().map(|place| place.tokens as f64).collect();
                for (id, times) in net.transition_ids().zip(firings) {
                    prop_assert!(times >= 0.0);
                    net.taken(id).for_each(|(place, weight)| marking[place.index()] -= weight as f64 * times);
                    net.put(id).for_each(|(place, weight)| marking[place.index()] += weight as f64 * times);
                }
                prop_assert!(marking.iter().all(|&tokens| tokens > -1e-4));
                for one in &constraints {
                    let sum: f64 = one.terms.iter().map(|&(place, times)| times as f64 * marking[place.index()]).sum();
                    let value = one.value as f64;
                    let is_satisfied = match one.relation {
                        Relation::AtLeast => sum > value - 1e-4,
                        Relation::AtMost => sum < value + 1e-4,
                        Relation::Equal => (sum - value).abs() < 1e-4,
                    };
                    prop_assert!(is_satisfied);
                }
            }
            Outcome::Unknown => prop_assert!(false, "small problems are solved"),
        }
    }

    #[test]
    fn bounds_are_never_below_what_is_reached(net in net(6, 7, 3), places in prop::collection::vec(0..6_usize, 1..=4)) {
        let places: Vec<PlaceId> = places.into_iter().map(|place| PlaceId::at(place % net.places().len())).collect();
        let (markings, _) = reachable(&net);
        let most = markings.iter().map(|marking| places.iter().map(|place| marking[place.index()]).sum::<u64>()).max();
        let problem = Problem::new(&net);
        if let Some(bound) = problem.bound(&places, STEPS) {
            prop_assert!(bound.verify(&net, &places));
            prop_assert!(Some(bound.most) >= most, "{} < {most:?}", bound.most);
            // It is the best the state equation gives: more is a contradiction, and so much, as a fraction, is not.
            let more = |value| [Constraint {
                terms: places.iter().map(|&place| (place, 1)).collect(),
                relation: Relation::AtLeast,
                value,
            }];
            let infeasible = |value: u64| matches!(problem.solve(&more(value as i64), STEPS), Outcome::Infeasible(_));
            prop_assert!(infeasible(bound.most + 1));
            prop_assert!(bound.most == 0 || !infeasible(bound.most));
        }
    }
}

/// Ordinary nets where transitions that share an input have all inputs in common. What they put is mostly what others need.
fn free_choice_net() -> impl Strategy<Value = Net> {
    let shape = (prop::collection::vec((0..3_usize, 0..=1_u64), 1..=6), 1..=7_usize);
    shape.prop_flat_map(|(places, transitions)| {
        let outputs = prop::collection::btree_set(0..places.len(), 0..=2);
        let transitions =
            prop::collection::vec((0..3_usize, prop::option::weighted(0.9, 0..3_usize), outputs), transitions);
        (Just(places), transitions).prop_map(|(places, transitions)| {
            let of = |cluster: usize| (0..places.len()).filter(|&p| places[p].0 == cluster).collect::<Vec<_>>();
            let arcs = |places: &[usize]| places.iter().map(|&p| (PlaceId::at(p), 1)).collect::<Vec<_>>();
            let mut builder = Builder::new("free choice");
            for (i, &(_, tokens)) in places.iter().enumerate() {
                builder.place_with(format!("p{i}"), tokens);
            }
            for (i, (cluster, next, outputs)) in transitions.iter().enumerate() {
                let put = next.map_or_else(|| outputs.iter().copied().collect(), of);
                builder.weighted(format!("t{i}"), &arcs(&of(*cluster)), &arcs(&put), &[]);
            }
            builder.build()
        })
    })
}

/// Nets where each place has one producer and one consumer.
fn marked_graph() -> impl Strategy<Value = Net> {
    (1..=5_usize).prop_flat_map(|transitions| {
        let places = prop::collection::vec((0..transitions, 0..transitions, 0..=1_u64), 1..=7);
        places.prop_map(move |places| {
            let mut builder = Builder::new("marked graph");
            let ids: Vec<_> =
                places.iter().enumerate().map(|(i, place)| builder.place_with(format!("p{i}"), place.2)).collect();
            for t in 0..transitions {
                let side = |end: fn(&(usize, usize, u64)) -> usize| {
                    let mine = places.iter().zip(&ids).filter(|(place, _)| end(place) == t);
                    mine.map(|(_, &id)| (id, 1)).collect::<Vec<_>>()
                };
                builder.weighted(format!("t{t}"), &side(|place| place.1), &side(|place| place.0), &[]);
            }
            builder.build()
        })
    })
}

fn bits(places: &[PlaceId]) -> u32 {
    places.iter().fold(0, |set, place| set | 1 << place.index())
}

fn set(bits: u32, places: usize) -> FixedBitSet {
    let mut set = FixedBitSet::with_capacity(places);
    (0..places).filter(|place| bits >> place & 1 == 1).for_each(|place| set.insert(place));
    set
}

/// Whether every transition can fire again, whatever was fired.
fn is_live(net: &Net, naive: &Naive) -> bool {
    net.transition_ids().all(|id| {
        // Markings from which the transition can be fired at last, by going backwards.
        let mut able: BTreeSet<&Marking> =
            naive.steps.iter().filter(|(_, fired, _)| *fired == id.index()).map(|(from, ..)| from).collect();
        loop {
            let more: Vec<&Marking> = naive
                .steps
                .iter()
                .filter(|(from, _, to)| able.contains(to) && !able.contains(from))
                .map(|(from, ..)| from)
                .collect();
            if more.is_empty() {
                return able.len() == naive.markings.len();
            }
            able.extend(more);
        }
    })
}

fn check_kernel(matrix: &Matrix, kernel: &petril::structure::Kernel) -> Result<(), TestCaseError> {
    prop_assert_eq!(kernel.rank, rank(matrix.clone()));
    prop_assert_eq!(kernel.vectors.len(), matrix.len() - kernel.rank);
    let columns = matrix.first().map_or(0, Vec::len);
    let dense = |vector: &Vec<(u32, i128)>| {
        let mut row = vec![0; matrix.len()];
        vector.iter().for_each(|&(position, weight)| row[position as usize] = weight);
        row
    };
    for vector in &kernel.vectors {
        let sum =
            |column: usize| vector.iter().map(|&(row, weight)| weight * matrix[row as usize][column]).sum::<i128>();
        prop_assert!((0..columns).all(|column| sum(column) == 0));
    }
    prop_assert_eq!(rank(kernel.vectors.iter().map(dense).collect()), kernel.vectors.len());
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn invariants_are_those_of_all_supports(net in net(7, 6, 3)) {
        let matrix = incidence(&net);
        let turned = transposed(&matrix, net.transitions().len());
        let known = Incidence::of(&net);
        let places = place_invariants(&net, &known, Limits::default());
        prop_assert!(places.all);
        let found: BTreeSet<Vec<(usize, u64)>> = places.found.iter()
            .map(|one| one.weights.iter().map(|&(place, weight)| (place.index(), weight)).collect())
            .collect();
        prop_assert_eq!(found, semiflows(&matrix));
        for one in &places.found {
            prop_assert_eq!(one.tokens, one.weights.iter().map(|&(p, w)| w * net.place(p).tokens).sum::<u64>());
        }
        let transitions = transition_invariants(&net, &known, Limits::default());
        prop_assert!(transitions.all);
        let found: BTreeSet<Vec<(usize, u64)>> = transitions.found.iter()
            .map(|one| one.firings.iter().map(|&(id, times)| (id.index(), times)).collect())
            .collect();
        prop_assert_eq!(found, semiflows(&turned));
        check_kernel(&matrix, &place_basis(&net, &known, 1_000_000).unwrap())?;
        check_kernel(&turned, &transition_basis(&net, &known, 1_000_000).unwrap())?;
    }

    #[test]
    fn siphons_and_traps_are_those_of_all_sets(net in net(8, 8, 2), within in any::<u32>()) {
        let flow = Flow::of(&net);
        let places = net.places().len();
        let within = within & ((1 << places) - 1);
        let union = |sets: &[u32]| sets.iter().filter(|&&set| set & !within == 0).fold(0, |all, set| all | set);
        for (all, found, largest) in [
            (siphons(&net), minimal_siphons(&flow, SiphonLimits::default()), largest_siphon(&flow, &set(within, places))),
            (traps(&net), minimal_traps(&flow, SiphonLimits::default()), largest_trap(&flow, &set(within, places))),
        ] {
            prop_assert!(found.all);
            let sets: Vec<u32> = found.found.iter().map(|places| bits(places)).collect();
            prop_assert_eq!(sets.iter().copied().collect::<BTreeSet<_>>(), minimal(&all));
            prop_assert_eq!(sets.len(), minimal(&all).len(), "none is found twice");
            prop_assert_eq!(largest, set(union(&all), places));
        }
    }

    #[test]
    fn what_siphons_say_of_behaviour_is_true(net in prop_oneof![net(6, 7, 2), free_choice_net(), marked_graph()]) {
        let flow = Flow::of(&net);
        let class = Class::of(&net, &flow);
        let property = commoner(&net, &flow, &minimal_siphons(&flow, SiphonLimits::default()));
        // The property by its definition.
        let marked = net.place_ids().filter(|&place| net.place(place).is_marked()).collect::<Vec<_>>();
        let traps = traps(&net);
        let has_marked_trap =
            |siphon: u32| traps.iter().any(|trap| trap & !siphon == 0 && trap & bits(&marked) != 0);
        let has_arcs = |siphon: u32| (0..net.places().len())
            .any(|place| siphon >> place & 1 == 1 && net.transition_ids().any(|id| net.pre(id).any(|(p, _)| p.index() == place)));
        let holds = minimal(&siphons(&net)).into_iter().all(|siphon| has_marked_trap(siphon) || !has_arcs(siphon));
        prop_assert_eq!(property == Commoner::Holds, holds);

        if let Some(naive) = search(&Model::from(&net), 300) {
            let fired: BTreeSet<usize> = naive.steps.iter().map(|&(_, id, _)| id).collect();
            for id in starved(&net, &flow) {
                prop_assert!(!fired.contains(&id.index()));
            }
            if property.excludes_deadlock(&class, &flow) {
                prop_assert_eq!(naive.deadlocks().len(), 0);
            }
            if let Some(live) = property.decides_liveness(&class) {
                prop_assert_eq!(live, is_live(&net, &naive));
            }
        }
    }

    #[test]
    fn classes_are_those_of_the_definitions(net in prop_oneof![net(5, 5, 1), net(5, 5, 2), free_choice_net(), marked_graph()]) {
        let flow = Flow::of(&net);
        let class = Class::of(&net, &flow);
        let weights = net.transition_ids().flat_map(|id| net.pre(id).chain(net.post(id))).map(|(_, weight)| weight);
        let ordinary = weights.clone().all(|weight| weight == 1);
        prop_assert_eq!(class.ordinary, ordinary);
        let consumers = |place: PlaceId| -> Vec<TransitionId> {
            net.transition_ids().filter(|&id| net.pre(id).any(|(p, _)| p == place)).collect()
        };
        let inputs = |id: TransitionId| net.pre(id).map(|(place, _)| place).collect::<Vec<_>>();
        let free = net.place_ids().all(|place| {
            consumers(place).len() <= 1 || consumers(place).iter().all(|&id| inputs(id) == [place])
        });
        let shares = |p: PlaceId, q: PlaceId| consumers(p).iter().any(|id| consumers(q).contains(id));
        let extended = net.place_ids()
            .all(|p| net.place_ids().all(|q| !shares(p, q) || consumers(p) == consumers(q)));
        prop_assert_eq!(class.free_choice, ordinary && free);
        prop_assert_eq!(class.extended_free_choice, ordinary && extended);
        let keeps = net.transition_ids()
            .all(|id| net.pre(id).map(|(_, w)| w).sum::<u64>() == net.post(id).map(|(_, w)| w).sum::<u64>());
        prop_assert_eq!(class.keeps_tokens, keeps);

        // Components, by what leads where.
        let (places, count) = (net.places().len(), net.places().len() + net.transitions().len());
        let mut leads: Vec<Vec<bool>> = (0..count).map(|a| (0..count).map(|b| a == b).collect()).collect();
        for id in net.transition_ids() {
            net.pre(id).for_each(|(place, _)| leads[place.index()][places + id.index()] = true);
            net.post(id).for_each(|(place, _)| leads[places + id.index()][place.index()] = true);
        }
        let both: Vec<Vec<bool>> = (0..count).map(|a| (0..count).map(|b| leads[a][b] || leads[b][a]).collect()).collect();
        let count_of = |mut leads: Vec<Vec<bool>>| {
            for c in 0..count {
                for a in 0..count {
                    for b in 0..count {
                        leads[a][b] |= leads[a][c] && leads[c][b];
                    }
                }
            }
            (0..count).filter(|&a| !(0..a).any(|b| leads[a][b] && leads[b][a])).count()
        };
        prop_assert_eq!(Components::of(&flow), Components { weakly: count_of(both), strongly: count_of(leads) });
    }
}

/// Places with weights.
type Side<'a> = &'a [(&'a str, u64)];

/// A net from a list of places with tokens, and of transitions with what they take and put.
fn made(places: Side<'_>, transitions: &[(&str, Side<'_>, Side<'_>)]) -> Net {
    let mut builder = Builder::new("made");
    places.iter().for_each(|&(name, tokens)| _ = builder.place_with(name, tokens));
    let id = |name: &str| PlaceId::at(places.iter().position(|&(place, _)| place == name).unwrap());
    for (name, take, put) in transitions {
        let [take, put] = [take, put].map(|list| list.iter().map(|&(p, weight)| (id(p), weight)).collect::<Vec<_>>());
        builder.weighted(name, &take, &put, &[]);
    }
    builder.build()
}

fn named(net: &Net, sets: &[Vec<PlaceId>]) -> Vec<String> {
    sets.iter().map(|set| set.iter().map(|&p| net.place(p).name).collect::<Vec<_>>().join(" ")).collect()
}

/// Place invariants as texts like `a 2b = 3`.
fn invariants(net: &Net, summary: &Summary) -> Vec<String> {
    let text = |one: &petril::structure::PlaceInvariant| {
        let term = |&(place, weight): &(PlaceId, u64)| {
            let name = net.place(place).name;
            if weight == 1 { name.to_owned() } else { format!("{weight}{name}") }
        };
        format!("{} = {}", one.weights.iter().map(term).collect::<Vec<_>>().join(" "), one.tokens)
    };
    let mut texts: Vec<String> = summary.place_invariants.found.iter().map(text).collect();
    texts.sort();
    texts
}

/// Two processes and a lock.
#[test]
fn mutual_exclusion() {
    let net = made(
        &[("lock", 1), ("idle1", 1), ("busy1", 0), ("idle2", 1), ("busy2", 0)],
        &[
            ("enter1", &[("lock", 1), ("idle1", 1)], &[("busy1", 1)]),
            ("leave1", &[("busy1", 1)], &[("lock", 1), ("idle1", 1)]),
            ("enter2", &[("lock", 1), ("idle2", 1)], &[("busy2", 1)]),
            ("leave2", &[("busy2", 1)], &[("lock", 1), ("idle2", 1)]),
        ],
    );
    let summary = Summary::of(&net, 1);
    assert_eq!(invariants(&net, &summary), ["idle1 busy1 = 1", "idle2 busy2 = 1", "lock busy1 busy2 = 1"]);
    assert_eq!(summary.transition_invariants.found.len(), 2);
    assert_eq!(
        (summary.rank, summary.is_conservative(), summary.is_consistent(&net)),
        (Some(2), Some(true), Some(true))
    );
    assert_eq!(summary.most_in_place(), Some(1));
    assert_eq!(named(&net, &summary.siphons.found), ["lock busy1 busy2", "idle1 busy1", "idle2 busy2"]);
    assert_eq!(summary.siphons, summary.traps);
    let class = summary.class;
    assert!(class.ordinary && class.pure && !class.extended_free_choice && !class.marked_graph && !class.keeps_tokens);
    assert!(summary.excludes_deadlock);
    assert_eq!(summary.is_live, None, "the net is no free choice net");
    assert_eq!(summary.components, Components { weakly: 1, strongly: 1 });

    let flow = Flow::of(&net);
    let one = minimal_siphons(&flow, SiphonLimits { count: 1, ..SiphonLimits::default() });
    assert_eq!(commoner(&net, &flow, &one), Commoner::Unknown);

    // Both at once contradicts the invariant of the lock.
    let [busy1, busy2] = ["busy1", "busy2"].map(|name| net.find_place(name).unwrap());
    let both =
        [busy1, busy2].map(|place| Constraint { terms: vec![(place, 1)], relation: Relation::AtLeast, value: 1 });
    let problem = Problem::new(&net);
    let Outcome::Infeasible(certificate) = problem.solve(&both, STEPS) else { panic!("they exclude each other") };
    assert!(certificate.verify(&net, &both));
    assert!(!certificate.verify(&net, &both[..1]), "one alone is possible");
    assert_eq!(problem.bound(&[busy1, busy2], STEPS).unwrap().most, 1);
    // Two idle and one lock, or one idle and one busy.
    assert_eq!(summary.bound.unwrap().most, 3);
}

/// Each of three takes the left fork, then the right one.
#[test]
fn philosophers_may_starve() {
    let net = made(
        &[("f0", 1), ("f1", 1), ("f2", 1), ("h0", 0), ("h1", 0), ("h2", 0), ("e0", 0), ("e1", 0), ("e2", 0)],
        &[
            ("left0", &[("f0", 1)], &[("h0", 1)]),
            ("left1", &[("f1", 1)], &[("h1", 1)]),
            ("left2", &[("f2", 1)], &[("h2", 1)]),
            ("right0", &[("h0", 1), ("f1", 1)], &[("e0", 1)]),
            ("right1", &[("h1", 1), ("f2", 1)], &[("e1", 1)]),
            ("right2", &[("h2", 1), ("f0", 1)], &[("e2", 1)]),
            ("done0", &[("e0", 1)], &[("f0", 1), ("f1", 1)]),
            ("done1", &[("e1", 1)], &[("f1", 1), ("f2", 1)]),
            ("done2", &[("e2", 1)], &[("f2", 1), ("f0", 1)]),
        ],
    );
    let summary = Summary::of(&net, 1);
    assert_eq!(invariants(&net, &summary), ["f0 h0 e0 e2 = 1", "f1 h1 e0 e1 = 1", "f2 h2 e1 e2 = 1"]);
    // All forks and all who eat: empty when each holds one fork.
    let Commoner::Fails(siphon) = &summary.commoner else { panic!("there is a deadlock") };
    assert_eq!(named(&net, std::slice::from_ref(siphon)), ["f0 f1 f2 e0 e1 e2"]);
    assert!(!summary.excludes_deadlock && summary.is_live.is_none());
}

/// Pieces come in twos and are taken in threes; a truck waits for six.
#[test]
fn weights_count() {
    let net = made(
        &[("free", 6), ("full", 0), ("truck", 1), ("loaded", 0)],
        &[
            ("make", &[("free", 2)], &[("full", 2)]),
            ("load", &[("full", 3), ("truck", 1)], &[("loaded", 3)]),
            ("drive", &[("loaded", 3)], &[("free", 3), ("truck", 1)]),
        ],
    );
    let summary = Summary::of(&net, 1);
    assert_eq!(invariants(&net, &summary), ["3truck loaded = 3", "free full loaded = 6"]);
    let firings: Vec<u64> = summary.transition_invariants.found[0].firings.iter().map(|&(_, times)| times).collect();
    assert_eq!(firings, [3, 2, 2]);
    assert!(!summary.class.ordinary && !summary.class.free_choice && !summary.class.single_inputs);
    assert!(!summary.excludes_deadlock && summary.is_live.is_none(), "inputs of several tokens");
    assert_eq!(summary.place_bounds, [Some(6), Some(6), Some(1), Some(3)]);
    assert_eq!(summary.bound.unwrap().most, 7);
}

/// A free choice net that a wrong choice blocks: both branches are waited for.
#[test]
fn commoner_decides_free_choice_nets() {
    let choice = |wait: Side<'_>, transitions: usize| {
        let all: [(&str, Side<'_>, Side<'_>); 4] = [
            ("left", &[("start", 1)], &[("a", 1)]),
            ("right", &[("start", 1)], &[("b", 1)]),
            ("join", wait, &[("start", 1)]),
            ("again", &[("b", 1)], &[("start", 1)]),
        ];
        made(&[("start", 1), ("a", 0), ("b", 0)], &all[..transitions])
    };
    let summary = Summary::of(&choice(&[("a", 1), ("b", 1)], 3), 1);
    assert_eq!((summary.class.free_choice, summary.is_live), (true, Some(false)));
    let summary = Summary::of(&choice(&[("a", 1)], 4), 1);
    assert_eq!((summary.class.state_machine, summary.is_live, summary.excludes_deadlock), (true, Some(true), true));
}

/// Where weights of inputs are more than 1, marked traps do not help.
#[test]
fn a_marked_trap_of_too_few_tokens_is_a_deadlock() {
    let net = made(&[("p", 1)], &[("t", &[("p", 2)], &[("p", 2)])]);
    let summary = Summary::of(&net, 1);
    assert_eq!((summary.commoner, summary.excludes_deadlock), (Commoner::Holds, false));
    assert_eq!(search(&Model::from(&net), 10).unwrap().deadlocks().len(), 1);
}

#[test]
fn limits_end_searches_and_are_told() {
    // Of n pairs one each: 2^n siphons.
    let mut builder = Builder::new("pairs");
    let pairs: Vec<[PlaceId; 2]> =
        (0..20).map(|i| [0, 1].map(|side| builder.place_with(format!("p{i}{side}"), 1))).collect();
    for i in 0..20 {
        for to in pairs[i] {
            let take: Vec<_> = pairs[(i + 19) % 20].iter().map(|&place| (place, 1)).collect();
            builder.weighted(format!("t{i}{}", to.index()), &take, &[(to, 1)], &[]);
        }
    }
    let net = builder.build();
    let flow = Flow::of(&net);
    let few = minimal_siphons(&flow, SiphonLimits { count: 10, steps: 1_000_000 });
    assert_eq!((few.found.len(), few.all), (10, false));
    assert!(!minimal_siphons(&flow, SiphonLimits { count: usize::MAX, steps: 100 }).all);
    assert!(matches!(commoner(&net, &flow, &few), Commoner::Fails(_)), "one is enough for that");
    let incidence = Incidence::of(&net);
    assert!(!place_invariants(&net, &incidence, Limits { rows_each: 0, rows: 3, work: 1000 }).all);
    assert_eq!(place_basis(&net, &incidence, 10), None);
    let problem = Problem::new(&net);
    let place = Constraint { terms: vec![(pairs[0][0], 1)], relation: Relation::AtLeast, value: 100 };
    assert_eq!(problem.solve(std::slice::from_ref(&place), 10), Outcome::Unknown);
    assert_eq!(problem.bound(&pairs[0], 10), None);
}

/// Nothing that is not a proof passes for one.
#[test]
fn certificates_that_are_tampered_with_fail() {
    let net = made(&[("a", 2), ("b", 0)], &[("t", &[("a", 1)], &[("b", 1)])]);
    let [a, b] = ["a", "b"].map(|name| net.find_place(name).unwrap());
    let much = [Constraint { terms: vec![(b, 1)], relation: Relation::AtLeast, value: 3 }];
    let right = Certificate { constraints: vec![1], places: vec![(a, 1)] };
    assert!(right.verify(&net, &much));
    let wrong = [
        // The firing increases b alone.
        Certificate { constraints: vec![1], places: vec![] },
        // Initially the sum is 4.
        Certificate { constraints: vec![1], places: vec![(a, 2)] },
        Certificate { constraints: vec![-1], places: vec![(a, 1)] },
        Certificate { constraints: vec![1], places: vec![(a, 1), (b, -1)] },
        Certificate { constraints: vec![], places: vec![(a, 1)] },
        Certificate { constraints: vec![i128::MAX], places: vec![(a, i128::MAX)] },
        Certificate { constraints: vec![1], places: vec![(PlaceId::at(7), 1)] },
    ];
    for certificate in wrong {
        assert!(!certificate.verify(&net, &much), "{certificate:?}");
    }
    let two = [Constraint { value: 2, ..much[0].clone() }];
    assert!(!right.verify(&net, &two), "two are possible");
    let bound = Problem::new(&net).bound(&[b], STEPS).unwrap();
    assert_eq!(bound.most, 2);
    assert!(!Bound { most: 1, ..bound.clone() }.verify(&net, &[b]));
    assert!(!bound.verify(&net, &[b, b]));
    assert!(!Bound { unit: 0, ..bound }.verify(&net, &[b]));
}

/// More pivots than a basis is kept for: a token has to go a long way, and machines move in step with their neighbours.
#[test]
fn long_ways_are_gone() {
    let (machines, states) = (20, 20);
    let mut builder = Builder::new("machines");
    let places: Vec<Vec<PlaceId>> = (0..machines)
        .map(|m| (0..states).map(|s| builder.place_with(format!("m{m}s{s}"), u64::from(s == 0))).collect())
        .collect();
    for m in 0..machines {
        for s in 0..states {
            let step = |machine: usize, state: usize| {
                ((places[machine][state], 1), (places[machine][(state + 1) % states], 1))
            };
            // A machine leaves its first state together with the next one's leaving its tenth.
            let mut moves = vec![step(m, s)];
            moves.extend((s == 0 && m + 1 < machines).then(|| step(m + 1, 10)));
            let (take, put): (Vec<_>, Vec<_>) = moves.into_iter().unzip();
            builder.weighted(format!("t{m}_{s}"), &take, &put, &[]);
        }
    }
    let net = builder.build();
    let problem = Problem::new(&net);
    let at = |machine: usize, state: usize, least: i64| Constraint {
        terms: vec![(places[machine][state], 1)],
        relation: Relation::AtLeast,
        value: least,
    };
    let solve = |constraints: &[Constraint]| problem.solve(constraints, 100 * STEPS);
    assert!(matches!(solve(&[at(0, 19, 1), at(19, 19, 1)]), Outcome::Feasible(_)));
    assert!(matches!(solve(&[at(7, 3, 2)]), Outcome::Infeasible(_)));
    assert!(matches!(solve(&[at(7, 3, 1), at(7, 4, 1)]), Outcome::Infeasible(_)));
    assert_eq!(problem.bound(&net.place_ids().collect::<Vec<_>>(), STEPS).unwrap().most, machines as u64);
}
