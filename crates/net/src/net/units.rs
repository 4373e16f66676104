//! Nested units: sets of places of which no two are ever marked together.

use super::PlaceId;

/// The places of a net in a tree of units (a *nested-unit Petri net*, NUPN; H. Garavel, *Nested-Unit Petri Nets*, 2019).
///
/// Each place is in one unit, each unit but the root in one other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Units {
    /// The units.
    pub units: Vec<Unit>,
    /// Position of the root, the unit that contains all others.
    pub root: usize,
    /// Whether the net is known to be unit-safe: in every reachable marking at most one place of a unit is marked, with
    /// one token, and none while a place of a unit within it is marked. `false` means unknown.
    pub safe: bool,
}

/// A unit of a nested-unit Petri net.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// Identifier, unique in the net.
    pub id: String,
    /// Local places: those of this unit and of no unit within it.
    pub places: Vec<PlaceId>,
    /// Direct subunits, by position.
    pub subunits: Vec<usize>,
}

impl Units {
    /// Returns units side by side, `u1`, `u2` and so on, in a root `u0` without places of its own. Units without places
    /// are left out.
    #[must_use]
    pub fn flat(units: impl IntoIterator<Item = Vec<PlaceId>>, safe: bool) -> Self {
        let units = [Vec::new()].into_iter().chain(units.into_iter().filter(|places| !places.is_empty()));
        let unit = |(i, places)| Unit { id: format!("u{i}"), places, subunits: Vec::new() };
        let mut units: Vec<Unit> = units.enumerate().map(unit).collect();
        units[0].subunits = (1..units.len()).collect();
        Self { units, root: 0, safe }
    }
}
