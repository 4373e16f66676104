//! Structural reductions: a smaller net that answers the same question.
//!
//! [`reduce`] takes a net and what a property sees of it ([`Keep`]) and applies the rules of a catalogue ([`Rule`]) until none
//! applies any more. Each rule has a file that says when it applies, which kind of property it keeps, and why. Whatever the rules
//! do, a run of the reduced net can be lifted to a run of the original ([`Reduced::lift`]); a lifted run has been replayed.
//!
//! A rule only looks at a place and its neighbours, or goes over the net once. Places wait in a queue for the rules of the
//! first kind, and come back when something changes around them. The others are applied in rounds.
//!
//! ```
//! use petril_net::net::Builder;
//! use petril_net::structure::reduce::{Keep, Property, reduce};
//!
//! // A token goes through ten places, one after the other.
//! let mut builder = Builder::new("line");
//! let places: Vec<_> = (0..10).map(|i| builder.place_with(format!("p{i}"), u64::from(i == 0))).collect();
//! for (i, pair) in places.windows(2).enumerate() {
//!     builder.weighted(format!("t{i}"), &[(pair[0], 1)], &[(pair[1], 1)], &[]);
//! }
//! let net = builder.build();
//!
//! let keep = Keep { places: vec![places[9]], ..Keep::nothing(Property::Reachability) };
//! let reduced = reduce(&net, &keep);
//! assert_eq!((reduced.net.places().len(), reduced.net.transitions().len()), (2, 1));
//! let run: Vec<_> = reduced.net.transition_ids().collect();
//! assert_eq!(reduced.lift(&run).expect("a run").len(), 9);
//! ```

mod agglomerate;
mod alive;
mod dead;
mod dominated;
mod draft;
mod fuse;
mod implied;
mod irrelevant;
mod lift;
mod log;
mod reduced;
mod rule;
mod scaled;
mod supply;
mod unrestricting;

pub use lift::LiftError;
pub use reduced::{Reduced, Size};
pub use rule::Rule;

use std::sync::atomic::AtomicBool;

use crate::net::{Net, PlaceId, TransitionId};
use draft::{Draft, MANY};

/// The kind of a property.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// What the kept places can have at the same time: the reachable markings, of which only the kept places are seen. This
    /// is enough for `EF` and `AG` of formulas about them, and for upper bounds of their tokens.
    Reachability,
    /// The same, and besides what the kept places can have in dead markings. This is enough for the question whether there is
    /// a deadlock, and for `EF (deadlock & f)` and `AG (deadlock -> f)`; not for `EF (!deadlock & f)`.
    Deadlock,
    /// All that can be said about markings and the steps between them, as far as kept places are seen: the graphs are bisimilar.
    /// This is enough for any formula of CTL or LTL, with the next-time operator, and with deadlocks. Few rules keep so much.
    Paths,
}

/// What a property sees.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Keep {
    /// Its kind.
    pub property: Property,
    /// The places whose tokens it counts.
    pub places: Vec<PlaceId>,
    /// The transitions of which it asks whether they are enabled. The places of their presets are kept.
    pub transitions: Vec<TransitionId>,
}

impl Keep {
    /// A property of this kind that sees no place and no transition.
    #[must_use]
    pub fn nothing(property: Property) -> Self {
        Self { property, places: Vec::new(), transitions: Vec::new() }
    }
}

/// What may be done.
#[derive(Clone, Debug)]
pub struct Options {
    /// The rules that may be applied.
    pub rules: Vec<Rule>,
    /// How often those that go over the whole net may do so.
    pub rounds: usize,
    /// About how many nodes and arcs may be looked at before no more rules are applied: a second is some ten million.
    pub work: u64,
}

impl Default for Options {
    /// All rules, and enough work for nets of hundreds of thousands of nodes.
    fn default() -> Self {
        Self { rules: Rule::ALL.to_vec(), rounds: 64, work: 200_000_000 }
    }
}

/// Reduces a net by all rules that keep what is asked for.
#[must_use]
pub fn reduce<'n>(net: &'n Net, keep: &Keep) -> Reduced<'n> {
    reduce_with(net, keep, &Options::default())
}

/// Reduces a net within limits.
#[must_use]
pub fn reduce_with<'n>(net: &'n Net, keep: &Keep, options: &Options) -> Reduced<'n> {
    reduce_until(net, keep, options, &AtomicBool::new(false))
}

/// Reduces a net within limits, and not further once `stopping` is set.
#[must_use]
pub fn reduce_until<'n>(net: &'n Net, keep: &Keep, options: &Options, stopping: &AtomicBool) -> Reduced<'n> {
    let Some(mut draft) = Draft::of(net, keep, options, stopping) else {
        return Reduced::unchanged(net, keep.property);
    };
    for _ in 0..options.rounds {
        let before = draft.applied;
        everywhere(&mut draft);
        draft.wake_hubs();
        while let Some(place) = draft.next_waiting().filter(|_| !draft.is_tired()) {
            around(&mut draft, place);
        }
        if draft.applied == before || draft.is_tired() {
            break;
        }
    }
    Reduced::of(net, keep.property, draft)
}

/// The rules that go over the whole net.
fn everywhere(draft: &mut Draft) {
    type Apply = fn(&mut Draft);
    const RULES: [(Rule, Apply); 9] = [
        (Rule::Dead, dead::apply),
        (Rule::Alive, alive::apply),
        (Rule::Irrelevant, irrelevant::apply),
        (Rule::Dominated, dominated::dominated),
        (Rule::Idle, dominated::idle),
        (Rule::Implied, implied::apply),
        (Rule::Supply, supply::apply),
        (Rule::Fusion, fuse::apply),
        (Rule::Composed, dominated::composed),
    ];
    for (rule, apply) in RULES {
        if draft.allows(rule) && !draft.is_tired() {
            apply(draft);
        }
    }
}

/// The rules that look at a place and its neighbours: the first that applies.
fn around(draft: &mut Draft, place: u32) {
    let agglomerates = draft.property != Property::Paths;
    let allows = |draft: &Draft, rule| draft.allows(rule);
    let _ = allows(draft, Rule::Unrestricting) && unrestricting::apply(draft, place)
        || allows(draft, Rule::Scaled) && scaled::apply(draft, place)
        || agglomerates && allows(draft, Rule::PostAgglomeration) && agglomerate::post(draft, place)
        || agglomerates && agglomerate::pre(draft, place);
}
