//! Random nets whose places mostly have no bound: sources, weights small and large, digits that grow, packings of one word and
//! of several.

use petril::explore::engine::{Arcs, Model};
use petril::net::{Builder, Net, PlaceId};
use proptest::prelude::*;
use proptest::sample::select;

/// A random net.
pub fn growing_model() -> impl Strategy<Value = Model> {
    prop_oneof![
        6 => counters(5, vec![0, 0, 1, 1, 2, 3], vec![1, 1, 1, 2, 3]),
        2 => counters(4, vec![0, 1, 14, 15, 16, 254, 255, 256], vec![1, 1, 2, 7, 100, 255, 256]),
        // Digits of many bits: markings of several words.
        2 => counters(4, vec![0, 1, 3, 1 << 33, 1 << 40, 1 << 50], vec![1, 1, 2, 1 << 20, 1 << 33]),
        2 => counters(12, vec![0, 0, 1, 255, 65_535], vec![1, 1, 2, 1000]),
        3 => modes(),
    ]
}

/// Places with these numbers of tokens, and transitions with these weights.
fn counters(places: usize, tokens: Vec<u64>, weights: Vec<u64>) -> impl Strategy<Value = Model> {
    (1..=places).prop_flat_map(move |places| {
        let (tokens, weights) = (tokens.clone(), weights.clone());
        let side = move |most| prop::collection::vec((0..places as u32, select(weights.clone())), 0..=most);
        let arcs = (side(2), side(3)).prop_map(|(pre, post)| Arcs { pre, post });
        let initial = prop::collection::vec(select(tokens), places);
        (initial, prop::collection::vec(arcs, 1..=6)).prop_map(|(initial, transitions)| Model { initial, transitions })
    })
}

/// A counter and by how much it changes, if one does.
type Counted = Option<(u32, u64)>;

/// A token that goes from mode to mode, and counters that it raises and lowers on its way.
fn modes() -> impl Strategy<Value = Model> {
    (2..6_u32, 1..4_u32).prop_flat_map(|(modes, counters)| {
        let counter = move || (modes..modes + counters, select(vec![1, 1, 1, 2, 5]));
        let step = (0..modes, 0..modes, prop::option::of(counter()), prop::option::of(counter()));
        prop::collection::vec(step, 1..=8).prop_map(move |steps| {
            let mut initial = vec![0; (modes + counters) as usize];
            initial[0] = 1;
            let arcs = |(from, to, pre, post): (u32, u32, Counted, Counted)| Arcs {
                pre: [(from, 1)].into_iter().chain(pre).collect(),
                post: [(to, 1)].into_iter().chain(post).collect(),
            };
            Model { initial, transitions: steps.into_iter().map(arcs).collect() }
        })
    })
}

/// The net with places `p0`, `p1`, … and transitions `t0`, `t1`, ….
pub fn net_of(model: &Model) -> Net {
    let mut builder = Builder::new("growing");
    let places: Vec<PlaceId> = model
        .initial
        .iter()
        .enumerate()
        .map(|(number, &tokens)| builder.place_with(format!("p{number}"), tokens))
        .collect();
    for (number, arcs) in model.transitions.iter().enumerate() {
        let side = |side: &[(u32, u64)]| side.iter().map(|&(place, n)| (places[place as usize], n)).collect::<Vec<_>>();
        builder.weighted(format!("t{number}"), &side(&arcs.pre), &side(&arcs.post), &[]);
    }
    builder.build()
}
