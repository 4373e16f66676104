//! Nested units: which places are never marked together.

use super::PlaceId;

/// The places of a net in a tree of units (a *nested-unit Petri net*, NUPN; H. Garavel, *Nested-Unit Petri Nets*, 2019).
///
/// Each place is in one unit, each unit but the root in one other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Units {
    /// The units.
    pub units: Vec<Unit>,
    /// The position of the unit that all others are in.
    pub root: usize,
    /// Whether it is known that of a unit's places one at most is marked, and none while a place of a unit within it is, in
    /// every reachable marking, with one token. If not, nobody knows.
    pub safe: bool,
}

/// A unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// What it is called, unique in its net.
    pub id: String,
    /// The places that are in it and in no unit within it.
    pub places: Vec<PlaceId>,
    /// The units directly within it, by position.
    pub subunits: Vec<usize>,
}

impl Units {
    /// Units side by side, `u1`, `u2` and so on, in a root `u0` that has no places of its own. Those without places are left
    /// out.
    #[must_use]
    pub fn flat(units: impl IntoIterator<Item = Vec<PlaceId>>, safe: bool) -> Self {
        let units = [Vec::new()].into_iter().chain(units.into_iter().filter(|places| !places.is_empty()));
        let unit = |(i, places)| Unit { id: format!("u{i}"), places, subunits: Vec::new() };
        let mut units: Vec<Unit> = units.enumerate().map(unit).collect();
        units[0].subunits = (1..units.len()).collect();
        Self { units, root: 0, safe }
    }
}
