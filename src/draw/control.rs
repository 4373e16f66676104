//! The way of the control token through a system: `idle`, the copying of each input, the lines, `End`, and back.

use crate::net::PlaceId;
use crate::semantics::{Role, VarId};
use crate::translate::{PlaceRole, System, TransitionRole};

/// The control places in the order in which the token passes them where no jump is taken, counted from 0.
pub struct Control {
    inputs: Vec<VarId>,
    end: usize,
}

impl Control {
    pub fn of(system: &System) -> Self {
        Self { inputs: system.program.with_role(Role::Input).collect(), end: system.program.end() }
    }

    /// How many control places there are.
    pub fn len(&self) -> usize {
        self.line(self.end) + 1
    }

    /// Where a place stands in the order, if control passes it.
    pub fn of_place(&self, role: PlaceRole) -> Option<usize> {
        match role {
            PlaceRole::Idle => Some(0),
            PlaceRole::Copy(input) => Some(self.copy(input)),
            PlaceRole::Line(line) => Some(self.line(line)),
            PlaceRole::Bit { .. } | PlaceRole::Result(_) | PlaceRole::Blocking(_) | PlaceRole::Plant(_) => None,
        }
    }

    /// Where the place stands from which a transition takes the token, if it does.
    pub fn of_transition(&self, role: TransitionRole) -> Option<usize> {
        match role {
            TransitionRole::Block => Some(0),
            TransitionRole::Copy { variable, .. } => Some(self.copy(variable)),
            TransitionRole::Line(line) => Some(self.line(line)),
            TransitionRole::Unblock => Some(self.line(self.end)),
            TransitionRole::Plant { .. } => None,
        }
    }

    /// All control places in their order.
    pub fn places(&self, system: &System) -> Vec<PlaceId> {
        let copies = self.inputs.iter().map(|&input| PlaceRole::Copy(input));
        let lines = (0..=self.end).map(PlaceRole::Line);
        [PlaceRole::Idle].into_iter().chain(copies).chain(lines).map(|role| system.place(role)).collect()
    }

    fn copy(&self, input: VarId) -> usize {
        1 + self.inputs.partition_point(|&earlier| earlier < input)
    }

    fn line(&self, line: usize) -> usize {
        1 + self.inputs.len() + line
    }
}
