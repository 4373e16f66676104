//! The token game and the interpreter side by side.

use std::fmt;

use crate::interpret::Machine;
use crate::logic::{Bound, Valuation};
use crate::net::{Marking, PlaceId, TransitionId};
use crate::semantics::{Role, VarId};
use crate::translate::{PlaceRole, System, TransitionRole};

/// Net, interpreter and search do not tell the same story. One of them is wrong, so there is no verdict.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Disagreement(pub String);

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A run of a system, both as firings and as instructions.
#[derive(Clone, Debug)]
pub struct Replay<'s> {
    system: &'s System,
    marking: Marking,
    machine: Machine<'s>,
}

impl<'s> Replay<'s> {
    /// The run that has not begun: power-on, control in `idle`.
    #[must_use]
    pub fn new(system: &'s System) -> Self {
        Self { system, marking: system.net.initial_marking(), machine: Machine::new(&system.program) }
    }

    /// The marking reached.
    #[must_use]
    pub fn marking(&self) -> &Marking {
        &self.marking
    }

    /// Whether the place of a role is marked.
    #[must_use]
    pub fn is_at(&self, role: PlaceRole) -> bool {
        self.marking.is_marked(self.system.place(role))
    }

    /// Fires a transition, executes what it stands for, and compares.
    ///
    /// # Errors
    /// The transition is not enabled, the net not safe, or net and interpreter differ afterwards.
    pub fn fire(&mut self, transition: TransitionId) -> Result<(), Disagreement> {
        let net = &self.system.net;
        let name = &net.transition(transition).name;
        if !net.is_enabled(&self.marking, transition) {
            return Err(Disagreement(format!("`{name}` is not enabled")));
        }
        net.fire(&mut self.marking, transition).map_err(|crate::net::NotSafe(place)| {
            Disagreement(format!("`{name}` marks `{}` twice", net.place(place).name))
        })?;
        match self.system.transitions[transition.index()] {
            TransitionRole::Block => self.machine.begin_scan(),
            TransitionRole::Copy { variable, value } => self.machine.set(variable, u64::from(value)),
            TransitionRole::Line(line) if line == self.machine.line() => {
                self.machine.step();
            }
            TransitionRole::Line(line) => {
                let expected = self.machine.line() + 1;
                return Err(Disagreement(format!(
                    "the net executes line {}, the interpreter line {expected}",
                    line + 1
                )));
            }
            TransitionRole::Unblock | TransitionRole::Plant { .. } => {}
        }
        self.compare().map_err(|what| Disagreement(format!("after `{name}`, net and interpreter differ in {what}")))
    }

    /// Fires the one enabled transition among those of these roles.
    ///
    /// # Errors
    /// There is not exactly one, or [`Replay::fire`] fails.
    pub fn fire_only(&mut self, of: impl Fn(TransitionRole) -> bool) -> Result<TransitionId, Disagreement> {
        let net = &self.system.net;
        let candidates = net.transition_ids().filter(|id| of(self.system.transitions[id.index()]));
        let enabled: Vec<TransitionId> = candidates.filter(|&id| net.is_enabled(&self.marking, id)).collect();
        let &[only] = enabled.as_slice() else {
            return Err(Disagreement(format!("{} transitions are enabled where one should be", enabled.len())));
        };
        self.fire(only)?;
        Ok(only)
    }

    fn compare(&self) -> Result<(), String> {
        let machine_is_running = self.system.places.iter().zip(self.system.net.place_ids());
        for (&role, place) in machine_is_running {
            let expected = match role {
                PlaceRole::Bit { variable, value } => (self.machine.value(variable) == 1) == value,
                PlaceRole::Result(value) => (self.machine.result() == 1) == value,
                // Before the program runs, control is in the system program.
                PlaceRole::Line(line) if self.marking.is_marked(place) => self.machine.line() == line,
                _ => continue,
            };
            let agrees = match role {
                PlaceRole::Line(_) => expected,
                _ => self.marking.is_marked(place) == expected,
            };
            if !agrees {
                return Err(format!("`{}`", self.system.net.place(place).name));
            }
        }
        Ok(())
    }

    /// The values of the variables, as the net has them.
    #[must_use]
    pub fn memory(&self) -> Vec<u64> {
        let variables = 0..self.system.program.variables.len();
        variables.map(|v| u64::from(self.is_at(PlaceRole::Bit { variable: VarId(v), value: true }))).collect()
    }

    /// Whether a formula about one state holds now, as the net has it. `None` for a temporal formula.
    #[must_use]
    pub fn holds(&self, formula: &Bound) -> Option<bool> {
        formula.holds_in(self)
    }
}

impl Valuation for Replay<'_> {
    fn value(&self, variable: VarId) -> u64 {
        debug_assert!(self.system.program.variable(variable).role != Role::Buffer);
        u64::from(self.is_at(PlaceRole::Bit { variable, value: true }))
    }

    fn is_marked(&self, place: PlaceId) -> bool {
        self.marking.is_marked(place)
    }

    fn is_enabled(&self, transition: TransitionId) -> bool {
        self.system.net.is_enabled(&self.marking, transition)
    }
}
