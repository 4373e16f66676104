//! Place/transition nets and their token game.
//!
//! A net is a tuple (P, T, F, W, m₀): places, transitions, arcs, their weights, and an initial marking. A transition is
//! enabled if each place of its preset has at least as many tokens as the weight of the arc from it; firing takes
//! these, and puts on each place of the postset as many as the weight of the arc to it. Self-loops, by which a
//! transition takes tokens and puts them back, are stored as read arcs, which are equivalent under interleaving.
//!
//! The nets of programs are *safe*: every arc has weight 1, and no reachable marking has two tokens on a place. For these
//! there is [`Marking`]; for any net, [`Tokens`].
//!
//! ```
//! use petril_net::net::{Arcs, Builder};
//!
//! let mut builder = Builder::new("two-phase clock");
//! let (low, high) = (builder.place("low", true), builder.place("high", false));
//! let rise = builder.transition("rise", Arcs { consume: &[low], produce: &[high], read: &[] });
//! let net = builder.build();
//!
//! let mut marking = net.initial_marking();
//! net.fire(&mut marking, rise).expect("high was empty");
//! assert!(marking.is_marked(high) && !marking.is_marked(low));
//! ```

mod arcs;
mod builder;
mod located;
mod marking;
mod names;
mod tokens;
mod units;
mod weighted;

pub use arcs::Arcs;
pub use builder::Builder;
pub use located::Located;
pub use marking::{Marking, NotSafe};
pub use tokens::{Overflow, Tokens};
pub use units::{Unit, Units};

use arcs::ArcTable;
use names::Names;
use petril_base::printable;
pub use petril_base::{PlaceId, TransitionId};

/// A place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place<'n> {
    /// Name, unique in the net.
    pub name: &'n str,
    /// Number of tokens in the initial marking.
    pub tokens: u64,
}

impl Place<'_> {
    /// Whether the place is marked initially.
    #[must_use]
    pub fn is_marked(&self) -> bool {
        self.tokens > 0
    }
}

/// A transition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transition<'n> {
    /// Name, unique in the net.
    pub name: &'n str,
    /// Arcs; see [`Net::arcs`].
    pub arcs: Arcs<'n>,
}

/// An immutable place/transition net, made by [`Builder`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Net {
    name: String,
    place_names: Names,
    tokens: Vec<u64>,
    transition_names: Names,
    arcs: ArcTable,
}

impl Net {
    /// Returns the net with all names made printable. Two nodes may then have the same name.
    #[must_use]
    pub fn into_printable(self) -> Self {
        let name = printable::line(&self.name);
        let (places, transitions) = (self.place_names.into_printable(), self.transition_names.into_printable());
        Self { name, place_names: places, transition_names: transitions, ..self }
    }

    fn empty(name: String) -> Self {
        let (place_names, transition_names) = (Names::default(), Names::default());
        Self { name, place_names, tokens: Vec::new(), transition_names, arcs: ArcTable::default() }
    }

    /// The name of the net.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The places, in the order of their ids.
    pub fn places(&self) -> impl ExactSizeIterator<Item = Place<'_>> + Clone {
        self.place_ids().map(|id| self.place(id))
    }

    /// The transitions, in the order of their ids.
    pub fn transitions(&self) -> impl ExactSizeIterator<Item = Transition<'_>> + Clone {
        self.transition_ids().map(|id| self.transition(id))
    }

    /// The ids of all places.
    pub fn place_ids(&self) -> impl ExactSizeIterator<Item = PlaceId> + Clone + use<> {
        (0..self.tokens.len()).map(PlaceId::at)
    }

    /// The ids of all transitions.
    pub fn transition_ids(&self) -> impl ExactSizeIterator<Item = TransitionId> + Clone + use<> {
        (0..self.arcs.len()).map(TransitionId::at)
    }

    /// The place with an id.
    #[must_use]
    pub fn place(&self, id: PlaceId) -> Place<'_> {
        Place { name: self.place_names.get(id.index()), tokens: self.tokens[id.index()] }
    }

    /// The transition with an id.
    #[must_use]
    pub fn transition(&self, id: TransitionId) -> Transition<'_> {
        Transition { name: self.transition_names.get(id.index()), arcs: self.arcs(id) }
    }

    /// Preset and postset of a transition, each list in ascending order. No place is in both `consume` and `produce`.
    /// With weights, a place may be in both `read` and `consume`: enabling then requires the sum of both weights. A
    /// place in both `read` and `produce` has more tokens after firing.
    #[must_use]
    pub fn arcs(&self, id: TransitionId) -> Arcs<'_> {
        self.arcs.get(id)
    }

    /// Tokens that a transition takes and does not put back: places, ascending, each with the number of tokens.
    pub fn taken(&self, id: TransitionId) -> impl Iterator<Item = (PlaceId, u64)> + Clone {
        weighted::list(self.arcs(id).consume, self.arcs.weights(id).consume)
    }

    /// Tokens that a transition puts in addition to those it puts back.
    pub fn put(&self, id: TransitionId) -> impl Iterator<Item = (PlaceId, u64)> + Clone {
        weighted::list(self.arcs(id).produce, self.arcs.weights(id).produce)
    }

    /// Tokens that a transition needs in addition to those it takes, and puts back.
    pub fn read(&self, id: TransitionId) -> impl Iterator<Item = (PlaceId, u64)> + Clone {
        weighted::list(self.arcs(id).read, self.arcs.weights(id).read)
    }

    /// Preset: the places that need tokens, ascending, each with the arc's weight.
    pub fn pre(&self, id: TransitionId) -> impl Iterator<Item = (PlaceId, u64)> + Clone {
        weighted::merge(self.taken(id), self.read(id))
    }

    /// Postset: the places that receive tokens, ascending, each with the arc's weight.
    pub fn post(&self, id: TransitionId) -> impl Iterator<Item = (PlaceId, u64)> + Clone {
        weighted::merge(self.put(id), self.read(id))
    }

    /// Finds a place by name.
    #[must_use]
    pub fn find_place(&self, name: &str) -> Option<PlaceId> {
        self.places().position(|place| place.name == name).map(PlaceId::at)
    }

    /// Finds a transition by name.
    #[must_use]
    pub fn find_transition(&self, name: &str) -> Option<TransitionId> {
        self.transitions().position(|transition| transition.name == name).map(TransitionId::at)
    }

    /// Number of arcs when every read arc is written as a loop of two arcs.
    #[must_use]
    pub fn arc_count(&self) -> usize {
        let twice = |id: TransitionId| {
            let arcs = self.arcs(id);
            arcs.read.iter().filter(|place| arcs.consume.contains(place) || arcs.produce.contains(place)).count()
        };
        self.arcs.count() + self.read_arc_count() - self.transition_ids().map(twice).sum::<usize>()
    }

    /// Number of read arcs.
    #[must_use]
    pub fn read_arc_count(&self) -> usize {
        self.transition_ids().map(|id| self.arcs(id).read.len()).sum()
    }
}
