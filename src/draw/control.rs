//! The path of the control token through a system: `idle`, the copying of each input, the lines, `End`, and back.

use petril_check::translate::{PlaceRole, System};
use petril_net::net::{PlaceId, TransitionId};

/// Control places in the order in which the token passes them when no jump is taken; rows count from 0.
pub struct Control<'a> {
    system: &'a System,
    places: Vec<PlaceId>,
    /// For each place of the net, its row if it is a control place.
    rows: Vec<Option<usize>>,
    /// For each transition of the net, the row of the control place that it takes the token from, if any.
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

    /// Number of control places.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Row of a place, if it is a control place.
    pub fn of_place(&self, place: PlaceId) -> Option<usize> {
        self.rows[place.index()]
    }

    /// Row of the control place that a transition takes the token from, if any.
    pub fn of_transition(&self, transition: TransitionId) -> Option<usize> {
        self.moves[transition.index()]
    }

    /// Transitions that take the token from the control place in a row.
    pub fn transitions(&self, row: usize) -> &[TransitionId] {
        self.system.moves(self.places[row])
    }

    /// Control places in order.
    pub fn places(&self) -> &[PlaceId] {
        &self.places
    }
}

/// Sort key of a control place: its part of the cycle, then its input or line, then its position within.
fn key(role: PlaceRole) -> (usize, usize, PlaceRole) {
    match role {
        PlaceRole::Copy(input) | PlaceRole::Copying(input, _) => (1, input.0, role),
        PlaceRole::Line(line) | PlaceRole::Within(line, _) | PlaceRole::Hazard(line, _) => (2, line, role),
        _ => (0, 0, role),
    }
}
