//! Positions of the nodes of a system net, for tools that show nets and have no layout of their own.
//!
//! Control places stand in the first column in the order in which the token passes them; the transitions that take the
//! token from each stand half a row below it. To the right come the bits, one per row, then the plant, one component
//! below the other.

use super::control::Control;
use petril_check::translate::{PlaceRole, System, TransitionRole};
use petril_net::format::pnml::{Point, Positions};

/// Distance between neighbouring columns.
const COLUMN: i32 = 140;
/// Distance between neighbouring rows.
const ROW: i32 = 100;
/// Distance between the first node and both edges.
const MARGIN: i32 = 60;

/// Places the nodes of a system.
#[must_use]
pub fn positions(system: &System) -> Positions {
    let control = Control::of(system);
    let in_row = (0..control.len()).map(|row| control.transitions(row).len());
    let bits = 2 + in_row.max().unwrap_or(0);
    let plant = bits + 3;
    let tops = component_tops(system);

    let mut in_component = vec![0; tops.len()];
    let mut pairs = system.result_width() as usize;
    let places = system.net.place_ids().zip(&system.places).map(|(place, &role)| match role {
        PlaceRole::Result { bit, value } => point(bits + usize::from(value), 2 * bit as usize),
        PlaceRole::Bit { value, .. } | PlaceRole::Register { value, .. } => {
            // The two places of a bit follow each other.
            pairs += usize::from(!value);
            point(bits + usize::from(value), 2 * (pairs - 1))
        }
        PlaceRole::Blocking(component) => point(plant + 1, 2 * tops[component] + 1),
        PlaceRole::Plant(component) => {
            in_component[component] += 1;
            point(plant, 2 * (tops[component] + in_component[component] - 1))
        }
        _ => point(0, 2 * control.of_place(place).unwrap_or_default()),
    });
    let mut column = vec![0; control.len()];
    let transitions = system.net.transition_ids().zip(&system.transitions).map(|(id, &role)| {
        match (role, control.of_transition(id)) {
            (TransitionRole::Plant { component, transition }, _) => {
                point(plant + 2, 2 * (tops[component] + transition) + 1)
            }
            (_, row) => {
                let row = row.unwrap_or_default();
                column[row] += 1;
                point(column[row], 2 * row + 1)
            }
        }
    });
    Positions { places: places.collect(), transitions: transitions.collect() }
}

/// First row of each component of the plant.
fn component_tops(system: &System) -> Vec<usize> {
    let heights = system.plant.components.iter().map(|c| c.places.len().max(c.transitions.len()) + 1);
    heights.scan(0, |top, height| Some(std::mem::replace(top, *top + height))).collect()
}

/// The point of a column and a half row.
fn point(column: usize, half_row: usize) -> Point {
    Point { x: MARGIN + COLUMN * column as i32, y: MARGIN + ROW / 2 * half_row as i32 }
}
