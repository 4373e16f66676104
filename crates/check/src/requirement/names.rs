//! Atoms of formulas in the words of a program and its net.

use petril_base::{PlaceId, TransitionId, VarId};
use petril_lang::flat::value_text;
use petril_lang::semantics::Role;
use petril_logic::Names;

use crate::translate::{PlaceRole, System};

impl Names for System {
    fn variable(&self, variable: VarId) -> String {
        self.program.variable(variable).name.clone()
    }

    fn literal(&self, variable: VarId, number: i128) -> Option<String> {
        let ty = self.program.variable(variable).ty;
        ty.holds(number).then(|| value_text(ty, ty.pattern(number)))
    }

    fn marked(&self, place: PlaceId) -> String {
        match self.places[place.index()] {
            PlaceRole::Bit { variable, bit: 0, value: true }
                if self.program.variable(variable).role != Role::Buffer =>
            {
                self.variable(variable)
            }
            PlaceRole::Line(line) if line == self.program.end() => "at End".to_owned(),
            PlaceRole::Line(line) => format!("at line {}", line + 1),
            PlaceRole::Idle => "at idle".to_owned(),
            _ => Names::marked(&self.net, place),
        }
    }

    fn tokens(&self, place: PlaceId) -> String {
        Names::tokens(&self.net, place)
    }

    fn enabled(&self, transition: TransitionId) -> String {
        Names::enabled(&self.net, transition)
    }
}
