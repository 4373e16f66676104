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
        reason = reason.or_else(|| of_atom(atom, system, view));
    });
    reason
}

fn of_atom(atom: Atom, system: &System, view: View) -> Option<&'static str> {
    let is_known = match atom {
        Atom::Variable(variable) | Atom::Word(variable) => variable.0 < system.program.variables.len(),
        Atom::Place(place) => place.index() < system.places.len(),
        Atom::Enabled(transition) => transition.index() < system.transitions.len(),
        Atom::Number(_) | Atom::Deadlock | Atom::Past => true,
    };
    if !is_known {
        return Some(OTHER_SYSTEM);
    }
    let is_there = match (view, atom) {
        (View::Scan, Atom::Number(_) | Atom::Variable(_) | Atom::Past) => true,
        // Fairness speaks of places that the end of a scan has, too.
        (View::Scan, Atom::Place(place)) => match system.places[place.index()] {
            PlaceRole::Plant(_) => true,
            PlaceRole::Bit { variable, .. } => system.program.variable(variable).role != Role::Buffer,
            _ => false,
        },
        (View::Scan, Atom::Word(_) | Atom::Enabled(_) | Atom::Deadlock) => false,
        (View::Transition, atom) => !matches!(atom, Atom::Variable(_) | Atom::Past),
    };
    (!is_there).then_some(OTHER_VIEW)
}
