//! Atoms of formulas.

use petril_base::{PlaceId, TransitionId, VarId};

use super::bound::{Bound, Term};
use super::past::Past;

/// Something a formula asks of a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Atom {
    /// Value of a variable.
    Variable(VarId),
    /// Number made of the places of a variable's bits, which come next.
    Word(VarId),
    /// Tokens on a place.
    Place(PlaceId),
    /// Whether a transition is enabled.
    Enabled(TransitionId),
    /// Whether no transition is enabled.
    Deadlock,
    /// A term about earlier scans; its own atoms come next.
    Past,
    /// A constant number.
    Number(i128),
}

impl Bound {
    /// Calls `visit` with each atom, as often as it occurs, those of terms about the past included.
    pub fn for_each_atom(&self, visit: &mut dyn FnMut(Atom)) {
        match self {
            Self::Truth(_) => {}
            Self::Variable(variable) | Self::Bit(variable, _) => visit(Atom::Variable(*variable)),
            Self::Marked(place) => visit(Atom::Place(*place)),
            Self::Enabled(transition) => visit(Atom::Enabled(*transition)),
            Self::Deadlock => visit(Atom::Deadlock),
            Self::Compare(_, left, right) => [left, right].into_iter().for_each(|term| term.for_each_atom(visit)),
            Self::Not(f) | Self::Next(_, f) => f.for_each_atom(visit),
            Self::And(f, g)
            | Self::Or(f, g)
            | Self::Implies(f, g)
            | Self::Iff(f, g)
            | Self::Until { hold: f, release: g, .. } => [f, g].into_iter().for_each(|part| part.for_each_atom(visit)),
            Self::Ltl(path) => path.atoms().into_iter().for_each(|atom| atom.for_each_atom(visit)),
        }
    }
}

impl Term {
    fn for_each_atom(&self, visit: &mut dyn FnMut(Atom)) {
        match self {
            Self::Number(number) => visit(Atom::Number(*number)),
            Self::Variable(variable, _) => visit(Atom::Variable(*variable)),
            Self::Bits { variable, places } => {
                visit(Atom::Word(*variable));
                places.iter().for_each(|&(place, _)| visit(Atom::Place(place)));
            }
            Self::Tokens(place) => visit(Atom::Place(*place)),
            Self::Truth(f) => f.for_each_atom(visit),
            Self::Sum(a, b) | Self::Difference(a, b) | Self::Product(a, b) => {
                [a, b].into_iter().for_each(|term| term.for_each_atom(visit));
            }
            Self::Past(past) => {
                visit(Atom::Past);
                match &**past {
                    Past::First => {}
                    Past::Before(term) => term.for_each_atom(visit),
                    Past::Since(f, g) => [f, g].into_iter().for_each(|part| part.for_each_atom(visit)),
                    Past::Run { of, .. } => of.for_each_atom(visit),
                }
            }
        }
    }
}
