//! What the subnets of all instructions are woven from: bits, control places, and steps between them.

use super::provenance::{PlaceRole, TransitionRole};
use crate::flat::{Operand, Target};
use crate::net::{Arcs, Builder, Net, PlaceId, TransitionId};
use crate::semantics::VarId;

/// Two complementary places, exactly one of them marked.
#[derive(Clone, Debug)]
pub struct Bit {
    name: String,
    /// The places for 0 and 1.
    places: [PlaceId; 2],
}

impl Bit {
    /// The place that is marked while the bit has this value.
    pub fn place(&self, value: bool) -> PlaceId {
        self.places[usize::from(value)]
    }
}

/// One bit in a step: its value before and after. A bit that keeps its value is only read.
pub type Change<'a> = (&'a Bit, bool, bool);

/// Builds a net and keeps what each node stands for.
pub struct Weaver {
    builder: Builder,
    place_roles: Vec<PlaceRole>,
    transition_roles: Vec<TransitionRole>,
    /// The current result, if the net has one.
    result: Option<Bit>,
    bits: Vec<Option<Bit>>,
}

impl Weaver {
    pub fn new(name: &str) -> Self {
        Self {
            builder: Builder::new(name),
            place_roles: Vec::new(),
            transition_roles: Vec::new(),
            result: None,
            bits: Vec::new(),
        }
    }

    pub fn place(&mut self, name: &str, marked: bool, role: PlaceRole) -> PlaceId {
        self.place_roles.push(role);
        self.builder.place(name, marked)
    }

    pub fn transition(&mut self, name: String, arcs: Arcs, role: TransitionRole) -> TransitionId {
        self.transition_roles.push(role);
        self.builder.transition(name, arcs)
    }

    /// Adds the bit of a variable.
    pub fn add_variable(&mut self, variable: VarId, name: &str, initial: bool) {
        let bit = self.bit(name, initial, |value| PlaceRole::Bit { variable, value });
        if self.bits.len() <= variable.0 {
            self.bits.resize(variable.0 + 1, None);
        }
        self.bits[variable.0] = Some(bit);
    }

    /// Adds the current result, 0 at the beginning.
    pub fn add_result(&mut self, name: &str) {
        self.result = Some(self.bit(name, false, PlaceRole::Result));
    }

    fn bit(&mut self, name: &str, initial: bool, role: impl Fn(bool) -> PlaceRole) -> Bit {
        let places = [false, true].map(|value| {
            let place = format!("{name}={}", u8::from(value));
            self.place(&place, value == initial, role(value))
        });
        Bit { name: name.to_owned(), places }
    }

    /// The bit of a variable that has been added.
    pub fn variable(&self, variable: VarId) -> Bit {
        self.bits[variable.0].clone().expect("every variable of the program has its bit")
    }

    /// The current result.
    pub fn result(&self) -> Bit {
        self.result.clone().expect("a program has a current result")
    }

    /// The finished net.
    pub fn build(self) -> (Net, Vec<PlaceRole>, Vec<TransitionRole>) {
        (self.builder.build(), self.place_roles, self.transition_roles)
    }
}

/// The place an instruction has in the net: between the control place of its line and those it can go on to.
pub struct Subnet<'a> {
    weaver: &'a mut Weaver,
    /// The line, from 0.
    line: usize,
    /// The control places of all lines, `End` the last.
    lines: &'a [PlaceId],
}

impl<'a> Subnet<'a> {
    pub fn new(weaver: &'a mut Weaver, line: usize, lines: &'a [PlaceId]) -> Self {
        Self { weaver, line, lines }
    }

    /// The line behind this one.
    pub fn next(&self) -> usize {
        self.line + 1
    }

    /// The current result.
    pub fn result(&self) -> Bit {
        self.weaver.result()
    }

    /// The bit of a variable.
    pub fn variable(&self, variable: VarId) -> Bit {
        self.weaver.variable(variable)
    }

    /// The values an operand can have, each with the bit that must have it (none for a literal).
    pub fn readings(&self, operand: Operand) -> Vec<(bool, Option<Bit>)> {
        match operand {
            Operand::Constant(value) => vec![(value == 1, None)],
            Operand::Place(Target::Element(_)) => Vec::new(),
            Operand::Place(Target::Variable(variable)) => {
                let bit = self.variable(variable);
                [false, true].map(|value| (value, Some(bit.clone()))).into()
            }
        }
    }

    /// One transition from this line to line `to`, enabled by the old values of the bits, which get the new ones.
    pub fn step(&mut self, to: usize, changes: &[Change<'_>]) {
        let mut arcs = Arcs { consume: vec![self.lines[self.line]], produce: vec![self.lines[to]], read: vec![] };
        for &(bit, before, after) in changes {
            if before == after {
                arcs.read.push(bit.place(before));
            } else {
                arcs.consume.push(bit.place(before));
                arcs.produce.push(bit.place(after));
            }
        }
        let conditions: Vec<String> =
            changes.iter().map(|(bit, before, _)| format!("{}={}", bit.name, u8::from(*before))).collect();
        let name = format!("line_{}[{}]", self.line + 1, conditions.join(","));
        self.weaver.transition(name, arcs, TransitionRole::Line(self.line));
    }
}

/// Both values of a bit.
pub const VALUES: [bool; 2] = [false, true];
