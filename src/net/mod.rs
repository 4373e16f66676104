//! Safe place/transition nets with read arcs, and their token game.
//!
//! A net is a tuple (P, T, F, R, m₀): places, transitions, arcs of weight 1, read arcs, and an initial marking of at most
//! one token a place. A transition is enabled if its preset and the places it reads are marked; firing takes the tokens
//! of the preset and puts one on each place of the postset. Under interleaving a read arc is a loop of two arcs, so the
//! builder takes every loop for a read arc.
//!
//! ```
//! use petril::net::{Arcs, Builder};
//!
//! let mut builder = Builder::new("two-phase clock");
//! let (low, high) = (builder.place("low", true), builder.place("high", false));
//! let rise = builder.transition("rise", Arcs { consume: vec![low], produce: vec![high], read: vec![] });
//! let net = builder.build();
//!
//! let mut marking = net.initial_marking();
//! net.fire(&mut marking, rise).expect("high was empty");
//! assert!(marking.is_marked(high) && !marking.is_marked(low));
//! ```

mod builder;
mod located;
mod marking;

pub use builder::{Arcs, Builder};
pub use located::Located;
pub use marking::{Marking, NotSafe};

/// A place, as a position in its net.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PlaceId(u32);

/// A transition, as a position in its net.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TransitionId(u32);

impl PlaceId {
    /// The place at a position, which must be one of the net's.
    #[must_use]
    pub fn at(index: usize) -> Self {
        Self(index as u32)
    }

    /// The position, from 0.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl TransitionId {
    /// The transition at a position, which must be one of the net's.
    #[must_use]
    pub fn at(index: usize) -> Self {
        Self(index as u32)
    }

    /// The position, from 0.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Its name, unique in the net.
    pub name: String,
    /// Whether it is marked at the beginning.
    pub marked: bool,
}

/// A transition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Transition {
    /// Its name, unique in the net.
    pub name: String,
    /// Preset and postset, each list in ascending order. A place from which a token is taken is in no other list; one
    /// that is both read and put to gets a second token if the transition fires.
    pub arcs: Arcs,
}

/// A net. Made by [`Builder`] and never changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Net {
    name: String,
    places: Vec<Place>,
    transitions: Vec<Transition>,
}

impl Net {
    /// The name of the net.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The places; [`PlaceId`] is the position.
    #[must_use]
    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// The transitions; [`TransitionId`] is the position.
    #[must_use]
    pub fn transitions(&self) -> &[Transition] {
        &self.transitions
    }

    /// The ids of all places.
    pub fn place_ids(&self) -> impl Iterator<Item = PlaceId> + Clone + use<> {
        (0..self.places.len()).map(PlaceId::at)
    }

    /// The ids of all transitions.
    pub fn transition_ids(&self) -> impl Iterator<Item = TransitionId> + Clone + use<> {
        (0..self.transitions.len()).map(TransitionId::at)
    }

    /// A place.
    #[must_use]
    pub fn place(&self, id: PlaceId) -> &Place {
        &self.places[id.index()]
    }

    /// A transition.
    #[must_use]
    pub fn transition(&self, id: TransitionId) -> &Transition {
        &self.transitions[id.index()]
    }

    /// The place of a name.
    #[must_use]
    pub fn find_place(&self, name: &str) -> Option<PlaceId> {
        self.place_ids().find(|&id| self.place(id).name == name)
    }

    /// The transition of a name.
    #[must_use]
    pub fn find_transition(&self, name: &str) -> Option<TransitionId> {
        self.transition_ids().find(|&id| self.transition(id).name == name)
    }

    /// How many arcs the net has where every read arc is written as a loop of two.
    #[must_use]
    pub fn arc_count(&self) -> usize {
        self.transitions.iter().map(|t| t.arcs.consume.len() + t.arcs.produce.len() + 2 * t.arcs.read.len()).sum()
    }

    /// How many read arcs the net has.
    #[must_use]
    pub fn read_arc_count(&self) -> usize {
        self.transitions.iter().map(|t| t.arcs.read.len()).sum()
    }
}
