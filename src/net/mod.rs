//! Place/transition nets, and their token game.
//!
//! A net is a tuple (P, T, F, W, m₀): places, transitions, arcs, their weights, and an initial marking. A transition is
//! enabled if each place of its preset has as many tokens as the arc from it weighs; firing takes them, and puts as many on
//! each place of the postset as the arc to it weighs. What a transition takes from a place and puts back at once is kept as
//! a read arc, which under interleaving is the same.
//!
//! The nets of programs are *safe*: every arc has weight 1, and no reachable marking has two tokens on a place. For these
//! there is [`Marking`]; for any net, [`Tokens`].
//!
//! ```
//! use petril::net::{Arcs, Builder};
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
    /// Its name, unique in the net.
    pub name: &'n str,
    /// The tokens it has at the beginning.
    pub tokens: u64,
}

impl Place<'_> {
    /// Whether it has a token at the beginning.
    #[must_use]
    pub fn is_marked(&self) -> bool {
        self.tokens > 0
    }
}

/// A transition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transition<'n> {
    /// Its name, unique in the net.
    pub name: &'n str,
    /// Its arcs; see [`Net::arcs`].
    pub arcs: Arcs<'n>,
}

/// A net. Made by [`Builder`] and never changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Net {
    name: String,
    place_names: Names,
    tokens: Vec<u64>,
    transition_names: Names,
    arcs: ArcTable,
}

impl Net {
    /// The net with all names as people read them. Two nodes may have the same name then.
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

    /// A place.
    #[must_use]
    pub fn place(&self, id: PlaceId) -> Place<'_> {
        Place { name: self.place_names.get(id.index()), tokens: self.tokens[id.index()] }
    }

    /// A transition.
    #[must_use]
    pub fn transition(&self, id: TransitionId) -> Transition<'_> {
        Transition { name: self.transition_names.get(id.index()), arcs: self.arcs(id) }
    }

    /// Preset and postset of a transition, each list in ascending order. No place is taken from and put to. With weights, a
    /// place may be read and taken from: it needs as many tokens as both weigh together. One that is read and put to has more
    /// tokens afterwards.
    #[must_use]
    pub fn arcs(&self, id: TransitionId) -> Arcs<'_> {
        self.arcs.get(id)
    }

    /// What a transition takes and does not put back: places, ascending, with how many tokens.
    pub fn taken(&self, id: TransitionId) -> impl Iterator<Item = (PlaceId, u64)> + Clone {
        weighted::list(self.arcs(id).consume, self.arcs.weights(id).consume)
    }

    /// What a transition puts besides what it puts back.
    pub fn put(&self, id: TransitionId) -> impl Iterator<Item = (PlaceId, u64)> + Clone {
        weighted::list(self.arcs(id).produce, self.arcs.weights(id).produce)
    }

    /// What a transition needs besides what it takes: it puts it back.
    pub fn read(&self, id: TransitionId) -> impl Iterator<Item = (PlaceId, u64)> + Clone {
        weighted::list(self.arcs(id).read, self.arcs.weights(id).read)
    }

    /// The arcs to a transition: the places it needs tokens on, ascending, with how many.
    pub fn pre(&self, id: TransitionId) -> impl Iterator<Item = (PlaceId, u64)> + Clone {
        weighted::merge(self.taken(id), self.read(id))
    }

    /// The arcs from a transition: the places it puts tokens on, ascending, with how many.
    pub fn post(&self, id: TransitionId) -> impl Iterator<Item = (PlaceId, u64)> + Clone {
        weighted::merge(self.put(id), self.read(id))
    }

    /// The place of a name.
    #[must_use]
    pub fn find_place(&self, name: &str) -> Option<PlaceId> {
        self.places().position(|place| place.name == name).map(PlaceId::at)
    }

    /// The transition of a name.
    #[must_use]
    pub fn find_transition(&self, name: &str) -> Option<TransitionId> {
        self.transitions().position(|transition| transition.name == name).map(TransitionId::at)
    }

    /// How many arcs the net has where every read arc is written as a loop of two.
    #[must_use]
    pub fn arc_count(&self) -> usize {
        let twice = |id: TransitionId| {
            let arcs = self.arcs(id);
            arcs.read.iter().filter(|place| arcs.consume.contains(place) || arcs.produce.contains(place)).count()
        };
        self.arcs.count() + self.read_arc_count() - self.transition_ids().map(twice).sum::<usize>()
    }

    /// How many read arcs the net has.
    #[must_use]
    pub fn read_arc_count(&self) -> usize {
        self.transition_ids().map(|id| self.arcs(id).read.len()).sum()
    }
}
