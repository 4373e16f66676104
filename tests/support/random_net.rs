//! Random nets: some safe by construction, some anything.

use petril::net::{Arcs, Builder, Net, PlaceId};
use proptest::prelude::*;

/// A safe net: up to three devices of one token each, and transitions that move the token of one or several of them, and
/// read places of any.
pub fn safe_net() -> impl Strategy<Value = Net> {
    let sizes = proptest::collection::vec(1..5_usize, 1..=3);
    let moves = proptest::collection::vec(proptest::option::weighted(0.6, (0..5_usize, 0..5_usize)), 3);
    let reads = proptest::collection::vec((0..3_usize, 0..5_usize), 0..2);
    (sizes, proptest::collection::vec((moves, reads), 0..9)).prop_map(|(sizes, transitions)| {
        let mut builder = Builder::new("safe");
        let mut device = |(d, &size): (usize, &usize)| -> Vec<_> {
            (0..size).map(|p| builder.place(format!("d{d}p{p}"), p == 0)).collect()
        };
        let devices: Vec<Vec<_>> = sizes.iter().enumerate().map(&mut device).collect();
        let place = |d: usize, p: usize| devices[d % devices.len()][p % devices[d % devices.len()].len()];
        for (t, (moves, reads)) in transitions.into_iter().enumerate() {
            let (mut consume, mut produce) = (Vec::new(), Vec::new());
            for (d, (from, to)) in moves.into_iter().enumerate().take(devices.len()).filter_map(|(d, m)| Some((d, m?)))
            {
                consume.push(place(d, from));
                produce.push(place(d, to));
            }
            // A device whose token is moved has no place that could be read as well, but the one it is taken from.
            let moved = |place: &_| devices.iter().any(|d| d.contains(place) && d.iter().any(|p| consume.contains(p)));
            let read: Vec<_> = reads.into_iter().map(|(d, p)| place(d, p)).filter(|place| !moved(place)).collect();
            builder.transition(format!("t{t}"), Arcs { consume: &consume, produce: &produce, read: &read });
        }
        builder.build()
    })
}

/// Any small net; most are not safe.
pub fn any_net() -> impl Strategy<Value = Net> {
    let list = || proptest::collection::vec(0..5_usize, 0..3);
    let transitions = proptest::collection::vec((list(), list(), list()), 0..6);
    (proptest::collection::vec(any::<bool>(), 5), transitions).prop_map(|(marked, transitions)| {
        let mut builder = Builder::new("any");
        let places: Vec<_> = marked.iter().enumerate().map(|(i, &m)| builder.place(format!("p{i}"), m)).collect();
        for (t, (consume, produce, read)) in transitions.into_iter().enumerate() {
            let ids = |list: Vec<usize>| list.into_iter().map(|p| places[p]).collect::<Vec<_>>();
            builder
                .transition(format!("t{t}"), Arcs { consume: &ids(consume), produce: &ids(produce), read: &ids(read) });
        }
        builder.build()
    })
}

/// Any small net with weights, loops and several tokens on a place; bounded or not. Most transitions have few arcs, so that
/// there are rows of places to make shorter.
pub fn weighted_net() -> impl Strategy<Value = Net> {
    let weight = || prop_oneof![8 => Just(1_u64), 2 => Just(2), 1 => Just(3)];
    let tokens = prop_oneof![6 => Just(0_u64), 3 => Just(1), 1 => 2..=4_u64];
    let side = move || {
        let arcs = move |count| proptest::collection::vec((0..9_usize, weight()), count);
        prop_oneof![1 => arcs(0), 6 => arcs(1), 3 => arcs(2), 1 => arcs(3)]
    };
    let test = proptest::option::weighted(0.1, (0..9_usize, weight()));
    let transitions = proptest::collection::vec((side(), side(), test), 0..=10);
    (proptest::collection::vec(tokens, 1..=9), transitions).prop_map(|(tokens, transitions)| {
        let mut builder = Builder::new("weighted");
        let add = |(i, &tokens): (usize, &u64)| builder.place_with(format!("p{i}"), tokens);
        let places: Vec<PlaceId> = tokens.iter().enumerate().map(add).collect();
        for (t, (take, put, test)) in transitions.into_iter().enumerate() {
            let ids = |list: Vec<(usize, u64)>| -> Vec<(PlaceId, u64)> {
                list.into_iter().map(|(place, weight)| (places[place % places.len()], weight)).collect()
            };
            let test = ids(test.into_iter().collect());
            builder.weighted(format!("t{t}"), &ids(take), &ids(put), &test);
        }
        builder.build()
    })
}
