//! Ids of the parts of a state: variables of flat code, places and transitions of a net.

use serde::{Deserialize, Serialize};

/// Variable of flat code, as a position in the program's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct VarId(pub usize);

/// Place, as a position in its net.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PlaceId(u32);

/// Transition, as a position in its net.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct TransitionId(u32);

impl PlaceId {
    /// The place at a position, which must be one of the net's.
    #[must_use]
    pub fn at(index: usize) -> Self {
        Self(index as u32)
    }

    /// Position in the net, from 0.
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

    /// Position in the net, from 0.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}
