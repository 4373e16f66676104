//! Random place/transition nets of every kind that the engine treats specially.

use std::collections::BTreeSet;

use petril::explore::engine::{Arcs, Model};
use proptest::prelude::*;

/// Arcs to random places with random weights.
fn arcs(places: usize, weight: u64) -> impl Strategy<Value = Arcs> {
    let side = || prop::collection::vec((0..places as u32, 0..=weight), 0..=3);
    (side(), side()).prop_map(|(pre, post)| Arcs { pre, post })
}

/// Any net: bounded or not, with loops, with several arcs to one place.
pub fn any_model() -> impl Strategy<Value = Model> {
    (1..=6_usize, 1..=3_u64).prop_flat_map(|(places, weight)| {
        let initial = prop::collection::vec(0..=3_u64, places);
        (initial, prop::collection::vec(arcs(places, weight), 0..=7))
            .prop_map(|(initial, transitions)| Model { initial, transitions })
    })
}

/// Nets in which each firing leaves the number of tokens as it is.
pub fn conserving_model() -> impl Strategy<Value = Model> {
    (2..=6_usize, 0..=20_u64).prop_flat_map(|(places, most)| {
        let moves = prop::collection::vec((0..places as u32, 0..places as u32, 1..=2_u64), 1..=2);
        let arcs = moves.prop_map(|moves| Arcs {
            pre: moves.iter().map(|&(from, _, weight)| (from, weight)).collect(),
            post: moves.iter().map(|&(_, to, weight)| (to, weight)).collect(),
        });
        (prop::collection::vec(0..=most, places), prop::collection::vec(arcs, 1..=7))
            .prop_map(|(initial, transitions)| Model { initial, transitions })
    })
}

/// Machines with a state each that move together, some of them sharing a state; packed markings can have many bits.
pub fn machines(machines: usize, states: u32, firings: usize) -> impl Strategy<Value = Model> {
    let size = prop::collection::vec(2..=states, 1..=machines);
    (size, any::<bool>()).prop_flat_map(move |(sizes, shared)| {
        let count = sizes.len();
        let step = prop::collection::vec((0..count, any::<u32>(), any::<u32>()), 1..=3.min(count));
        prop::collection::vec(step, 1..=firings).prop_map(move |steps| {
            // Place 0 is a state of every machine if they share one.
            let firsts: Vec<u32> =
                sizes.iter().scan(1, |next, size| Some(std::mem::replace(next, *next + size))).collect();
            let place = |machine: usize, state: u32| match state % sizes[machine] {
                0 if shared => 0,
                state => firsts[machine] + state,
            };
            let mut initial = vec![0; 1 + sizes.iter().sum::<u32>() as usize];
            (0..count).for_each(|machine| initial[place(machine, 0) as usize] = 1);
            let mut transitions: Vec<Arcs> = Vec::new();
            if shared {
                let post = (0..count).map(|machine| (place(machine, 1), 1)).collect();
                transitions.push(Arcs { pre: vec![(0, 1)], post });
            }
            for step in steps {
                let mut arcs = Arcs::default();
                let mut seen = BTreeSet::new();
                for (machine, from, to) in step {
                    let [from, to] = [from, to].map(|state| place(machine, state));
                    if seen.insert(machine) && (!shared || from != 0 && to != 0) {
                        arcs.pre.push((from, 1));
                        arcs.post.push((to, 1));
                    }
                }
                transitions.push(arcs);
            }
            Model { initial, transitions }
        })
    })
}
