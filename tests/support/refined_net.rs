//! Random nets made from small ones by doing the opposite of what reductions do, and then some harm: so there is much to
//! reduce, and much that is nearly right for a rule.

use petril::net::{Builder, Net, PlaceId};
use proptest::prelude::*;

/// What is done to a net, with numbers that say where.
#[derive(Clone, Copy, Debug)]
enum Change {
    /// A place comes between what a transition takes and what it puts.
    Split,
    /// The same, and the second part fires several times.
    SplitTimes,
    /// What a transition does is done by two of which each may start: a second transition before the place.
    OtherBefore,
    /// A second transition after a place.
    OtherAfter,
    /// Tokens of a place may go to a new one and back.
    Circle,
    /// A place that counts along with another one, perhaps in twos, perhaps with more tokens.
    Shadow,
    /// A transition needs tokens of a new place that another transition makes of nothing.
    Source,
    /// A place that only receives.
    Counter,
    /// A transition that does what two others do.
    Shortcut,
    /// A copy of a transition, perhaps with a loop.
    Copy,
    /// An arc from a place.
    Take,
    /// An arc to a place.
    Put,
    /// A loop.
    Test,
    /// A token.
    Token,
}

const CHANGES: [Change; 14] = [
    Change::Split,
    Change::SplitTimes,
    Change::OtherBefore,
    Change::OtherAfter,
    Change::Circle,
    Change::Shadow,
    Change::Shortcut,
    Change::Copy,
    Change::Source,
    Change::Counter,
    Change::Take,
    Change::Put,
    Change::Test,
    Change::Token,
];

type Arcs = Vec<(usize, u64)>;

#[derive(Clone, Debug, Default)]
struct Sketch {
    tokens: Vec<u64>,
    transitions: Vec<(Arcs, Arcs)>,
}

impl Sketch {
    fn place(&mut self, tokens: u64) -> usize {
        self.tokens.push(tokens);
        self.tokens.len() - 1
    }

    fn change(&mut self, change: Change, at: [usize; 3]) {
        let t = at[0] % self.transitions.len();
        let u = at[1] % self.transitions.len();
        let p = at[2] % self.tokens.len();
        let few = (at[1] % 3) as u64;
        match change {
            Change::Split | Change::SplitTimes => {
                let times = if matches!(change, Change::Split) { 1 } else { 1 + few };
                let new = self.place(0);
                let post = std::mem::replace(&mut self.transitions[t].1, vec![(new, times)]);
                self.transitions.push((vec![(new, 1)], post));
            }
            Change::OtherBefore => self.transitions.push((self.transitions[t].0.clone(), vec![(p, 1)])),
            Change::OtherAfter => self.transitions.push((vec![(p, 1)], self.transitions[t].1.clone())),
            Change::Circle => {
                let new = self.place(few / 2);
                self.transitions.extend([(vec![(p, 1)], vec![(new, 1)]), (vec![(new, 1)], vec![(p, 1)])]);
            }
            Change::Shadow => {
                let scale = 1 + few / 2;
                let new = self.place(self.tokens[p] * scale + (at[0] % 2) as u64);
                for (pre, post) in &mut self.transitions {
                    for side in [pre, post] {
                        let weight: u64 = side.iter().filter(|arc| arc.0 == p).map(|arc| arc.1).sum();
                        side.extend((weight > 0).then_some((new, weight * scale)));
                    }
                }
            }
            Change::Source => {
                let new = self.place(0);
                self.transitions[t].0.push((new, 1));
                self.transitions.push((Vec::new(), vec![(new, 1)]));
            }
            Change::Counter => {
                let new = self.place(few);
                self.transitions[t].1.push((new, 1 + few));
            }
            Change::Shortcut => {
                let (one, two) = (self.transitions[t].clone(), self.transitions[u].clone());
                let (mut pre, mut post) = ([one.0, two.0].concat(), [one.1, two.1].concat());
                // What the first puts and the second takes need not be there before.
                while let Some((i, j)) =
                    (0..pre.len()).flat_map(|i| (0..post.len()).map(move |j| (i, j))).find(|&(i, j)| pre[i] == post[j])
                {
                    pre.remove(i);
                    post.remove(j);
                }
                self.transitions.push((pre, post));
            }
            Change::Copy => {
                let (mut pre, mut post) = self.transitions[t].clone();
                let test = (few > 0).then_some((p, few));
                pre.extend(test);
                post.extend(test);
                self.transitions.push((pre, post));
            }
            Change::Take => self.transitions[t].0.push((p, 1)),
            Change::Put => self.transitions[t].1.push((p, 1)),
            Change::Test => {
                self.transitions[t].0.push((p, 1 + few / 2));
                self.transitions[t].1.push((p, 1 + few / 2));
            }
            Change::Token => self.tokens[p] += 1,
        }
    }

    fn net(&self) -> Net {
        let mut builder = Builder::new("refined");
        let add = |(i, &tokens): (usize, &u64)| builder.place_with(format!("p{i}"), tokens);
        let places: Vec<PlaceId> = self.tokens.iter().enumerate().map(add).collect();
        for (t, (pre, post)) in self.transitions.iter().enumerate() {
            let ids = |arcs: &Arcs| arcs.iter().map(|&(place, weight)| (places[place], weight)).collect::<Vec<_>>();
            builder.weighted(format!("t{t}"), &ids(pre), &ids(post), &[]);
        }
        builder.build()
    }
}

/// A net of up to four places in a circle, between which tokens move, changed several times.
pub fn refined_net() -> impl Strategy<Value = Net> {
    let moves =
        proptest::collection::vec((0..4_usize, 0..4_usize, proptest::option::of((0..4_usize, 0..4_usize))), 0..=2);
    let change = (prop_oneof![8 => 0..8_usize, 1 => 8..10_usize, 4 => 10..CHANGES.len()], any::<[u8; 3]>());
    let tokens = [1..=1_u64, 0..=1, 0..=1, 0..=2];
    (1..=4_usize, tokens, moves, proptest::collection::vec(change, 0..=8)).prop_map(
        |(places, tokens, moves, changes)| {
            let mut sketch = Sketch { tokens: vec![0; places], transitions: Vec::new() };
            sketch.tokens.iter_mut().zip(tokens).for_each(|(on, tokens)| *on = tokens);
            (0..places).for_each(|p| sketch.transitions.push((vec![(p, 1)], vec![((p + 1) % places, 1)])));
            for (from, to, more) in moves {
                let pairs = [Some((from, to)), more].into_iter().flatten();
                let (pre, post) = pairs.map(|(from, to)| ((from % places, 1), (to % places, 1))).unzip();
                sketch.transitions.push((pre, post));
            }
            changes.into_iter().for_each(|(change, at)| sketch.change(CHANGES[change], at.map(usize::from)));
            sketch.net()
        },
    )
}
