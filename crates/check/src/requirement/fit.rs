//! Formulas that were bound for another view, or for another system, than they are checked with.

use petril_lang::semantics::Role;
use petril_logic::{Atom, Bound, View};

use crate::translate::{PlaceRole, System};

const OTHER_VIEW: &str = "it was bound for the other view: bind it for the view that is checked";
const OTHER_SYSTEM: &str = "it was bound for another system: bind it for the one that is checked";

/// Reason why a formula does not fit the system and view that it is to be checked with; `None` if it does.
///
/// Atoms that the states of the view do not have would be FALSE in all of them. Ids of another system are found out where the
/// system has no such variable, place or transition.
#[must_use]
pub fn misfit(formula: &Bound, system: &System, view: View) -> Option<&'static str> {
    let mut reason = None;
    formula.for_each_atom(&mut |atom| {
        reason = reason.or(match (atom, view) {
            (Atom::Number(_), _) => None,
            (Atom::Variable(variable) | Atom::Word(variable), _) if variable.0 >= system.program.variables.len() => {
                Some(OTHER_SYSTEM)
            }
            (Atom::Place(place), _) if place.index() >= system.places.len() => Some(OTHER_SYSTEM),
            (Atom::Enabled(transition), _) if transition.index() >= system.transitions.len() => Some(OTHER_SYSTEM),
            // Fairness speaks of places that the end of a scan has, too.
            (Atom::Place(place), View::Scan) => match system.places[place.index()] {
                PlaceRole::Plant(_) => None,
                PlaceRole::Bit { variable, .. } if system.program.variable(variable).role != Role::Buffer => None,
                _ => Some(OTHER_VIEW),
            },
            (Atom::Word(_) | Atom::Enabled(_) | Atom::Deadlock, View::Scan) => Some(OTHER_VIEW),
            (Atom::Variable(_) | Atom::Past, View::Transition) => Some(OTHER_VIEW),
            _ => None,
        });
    });
    reason
}
