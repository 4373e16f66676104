//! Units of a system net (NUPN): sets of places that are never marked together, by construction, so that other tools
//! need not compute them.

use fixedbitset::FixedBitSet;

use super::plant::Component;
use super::provenance::PlaceRole;
use super::system::System;
use petril_net::net::{PlaceId, Units};

impl System {
    /// Units of the net: control, each bit, each blocking place, and the plant's components, split where several of
    /// their places can be marked. All units are safe.
    #[must_use]
    pub fn units(&self) -> Units {
        let of = |is_wanted: &dyn Fn(PlaceRole) -> bool| -> Vec<PlaceId> {
            self.net.place_ids().filter(|place| is_wanted(self.places[place.index()])).collect()
        };
        let mut units = vec![of(&PlaceRole::is_control)];
        // The two places of a bit have consecutive ids.
        units.extend(of(&PlaceRole::is_bit).chunks(2).map(<[PlaceId]>::to_vec));
        units.extend(of(&|role| matches!(role, PlaceRole::Blocking(_))).into_iter().map(|place| vec![place]));
        let mut members = vec![Vec::new(); self.plant.components.len()];
        for place in self.net.place_ids() {
            if let PlaceRole::Plant(component) = self.places[place.index()] {
                members[component].push(place);
            }
        }
        for (component, places) in self.plant.components.iter().zip(members) {
            let groups = exclusive(component);
            units.extend(groups.into_iter().map(|group| group.into_iter().map(|place| places[place]).collect()));
        }
        Units::flat(units, true)
    }
}

/// Groups of places of a component of which no reachable marking, for any values of the outputs, has two. Greedy: each
/// place goes to the first group it fits in.
fn exclusive(component: &Component) -> Vec<Vec<usize>> {
    let count = component.places.len();
    let mut together = vec![FixedBitSet::with_capacity(count); count];
    for marking in &component.markings {
        for &place in &marking.marked {
            together[place].extend(marking.marked.iter().copied());
        }
    }
    let mut groups: Vec<(FixedBitSet, Vec<usize>)> = Vec::new();
    for (place, marked_too) in together.iter().enumerate() {
        match groups.iter_mut().find(|(members, _)| members.is_disjoint(marked_too)) {
            Some((members, group)) => {
                members.insert(place);
                group.push(place);
            }
            None => {
                let mut members = FixedBitSet::with_capacity(count);
                members.insert(place);
                groups.push((members, vec![place]));
            }
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}
