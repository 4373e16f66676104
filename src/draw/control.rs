//! The way of the control token through a system: `idle`, the copying of each input, the lines, `End`, and back.

use petril_check::translate::{PlaceRole, System};
use petril_net::net::{PlaceId, TransitionId};

/// The control places in the order in which the token passes them where no jump is taken, counted from 0.
pub struct Control<'a> {
    system: &'a System,
    places: Vec<PlaceId>,
    /// For each place of the net, where it stands in the order, if control passes it.
    rows: Vec<Option<usize>>,
    /// For each transition of the net, where the place stands from which it takes the token, if it does.
    moves: Vec<Option<usize>>,
}

impl<'a> Control<'a> {
    pub fn of(system: &'a System) -> Self {
        let role = |place: PlaceId| system.places[place.index()];
        let mut places: Vec<PlaceId> = system.net.place_ids().filter(|&place| role(place).is_control()).collect();
        places.sort_by_key(|&place| key(role(place)));
        let mut rows = vec![None; system.places.len()];
        let mut moves = vec![None; system.transitions.len()];
        for (row, &place) in places.iter().enumerate() {
            rows[place.index()] = Some(row);
            system.moves(place).iter().for_each(|id| moves[id.index()] = Some(row));
        }
        Self { system, places, rows, moves }
    }

    /// How many control places there are.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Where a place stands in the order, if control passes it.
    pub fn of_place(&self, place: PlaceId) -> Option<usize> {
        self.rows[place.index()]
    }

    /// Where the place stands from which a transition takes the token, if it does.
    pub fn of_transition(&self, transition: TransitionId) -> Option<usize> {
        self.moves[transition.index()]
    }

    /// The transitions that take the token from the place that stands there.
    pub fn transitions(&self, row: usize) -> &[TransitionId] {
        self.system.moves(self.places[row])
    }

    /// All control places in their order.
    pub fn places(&self) -> &[PlaceId] {
        &self.places
    }
}

/// Orders control places: by where they are in the cycle, then by input or line, then within.
fn key(role: PlaceRole) -> (usize, usize, PlaceRole) {
    match role {
        PlaceRole::Copy(input) | PlaceRole::Copying(input, _) => (1, input.0, role),
        PlaceRole::Line(line) | PlaceRole::Within(line, _) | PlaceRole::Hazard(line, _) => (2, line, role),
        _ => (0, 0, role),
    }
}
