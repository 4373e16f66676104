//! The incidence matrix of a net, as a sparse matrix.

use crate::net::{Net, PlaceId, TransitionId};
use petril_base::Rows;

/// The incidence matrix, by rows and by columns. Read arcs change nothing and have no entries.
#[derive(Clone, Debug)]
pub struct Incidence {
    of_places: Rows<(u32, i128)>,
    of_transitions: Rows<(u32, i128)>,
}

impl Incidence {
    /// Returns the incidence matrix of a net.
    #[must_use]
    pub fn of(net: &Net) -> Self {
        let change = |id: TransitionId| {
            let lost = net.taken(id).map(|(place, weight)| (place, -i128::from(weight)));
            let gained = net.put(id).map(|(place, weight)| (place, i128::from(weight)));
            lost.chain(gained).map(move |(place, change)| (place.index(), id.index(), change))
        };
        let entries = net.transition_ids().flat_map(change);
        let of_places =
            Rows::group(net.places().len(), entries.clone().map(|(place, id, change)| (place, (id as u32, change))));
        // Built from places in ascending order, so that each list is ascending.
        let by_place = (0..net.places().len())
            .flat_map(|place| of_places[place].iter().map(move |&(id, change)| (id as usize, (place as u32, change))));
        let of_transitions = Rows::group(net.transitions().len(), by_place);
        Self { of_places, of_transitions }
    }

    /// Row of a place: the transitions that change it, ascending, with the tokens gained (negative: lost) by each
    /// firing.
    #[must_use]
    pub fn of_place(&self, place: PlaceId) -> &[(u32, i128)] {
        &self.of_places[place.index()]
    }

    /// Column of a transition: the places that it changes, ascending, with the tokens they gain (negative: lose).
    #[must_use]
    pub fn of_transition(&self, transition: TransitionId) -> &[(u32, i128)] {
        &self.of_transitions[transition.index()]
    }
}
