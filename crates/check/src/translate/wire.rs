//! Bits of an operand, each as the alternatives for its value.

use smallvec::smallvec;

use super::element;
use super::subnet::{Step, Subnet};
use super::weaver::{Bit, Change, Changes, VALUES};
use petril_lang::flat::{Operand, Target};
use petril_lang::semantics::Type;

/// Bit that is read, as alternatives: each is a value of the bit, with the bits that must have certain values for it.
#[derive(Clone, Debug)]
pub struct Wire(pub Vec<(bool, Changes)>);

impl Wire {
    /// Constant bit.
    pub fn fixed(value: bool) -> Self {
        Self(vec![(value, smallvec![])])
    }

    /// Bit of the net.
    pub fn of(bit: Bit) -> Self {
        Self(VALUES.map(|value| (value, smallvec![(bit, value, value)])).into())
    }

    /// Value of a constant bit.
    pub fn known(&self) -> Option<bool> {
        match self.0.as_slice() {
            [(value, given)] if given.is_empty() => Some(*value),
            _ => None,
        }
    }

    /// Complement of the bit.
    pub fn complement(mut self) -> Self {
        self.0.iter_mut().for_each(|(value, _)| *value = !*value);
        self
    }

    /// Step that assigns this bit to a bit of the net.
    pub fn assign(&self, target: Bit) -> Step {
        let mut step = Vec::with_capacity(2 * self.0.len());
        for (value, given) in &self.0 {
            for old in VALUES {
                step.push(with((target, old, *value), given));
            }
        }
        step
    }

    /// Alternatives of a step that reads the bit: `to` gives the next state for each value.
    pub fn branch<S>(&self, to: impl Fn(bool) -> S) -> Vec<(Changes, S)> {
        self.0.iter().map(|(value, given)| (given.clone(), to(*value))).collect()
    }
}

/// Change under conditions.
pub fn with(change: Change, given: &[Change]) -> Changes {
    let mut changes: Changes = smallvec![change];
    changes.extend_from_slice(given);
    changes
}

impl Subnet<'_> {
    /// Bits of an operand of a type, complemented if `negated`.
    pub fn wires(&self, ty: Type, negated: bool, operand: Operand) -> Vec<Wire> {
        let wires = (0..ty.width).map(|bit| self.wire(operand, bit));
        wires.map(|wire| if negated { wire.complement() } else { wire }).collect()
    }

    /// Bit of an operand.
    pub fn wire(&self, operand: Operand, bit: u32) -> Wire {
        match operand {
            Operand::Constant(pattern) => Wire::fixed(pattern >> bit & 1 == 1),
            Operand::Place(Target::Variable(variable)) => {
                self.variable(variable).get(bit as usize).map_or(Wire::fixed(false), |&bit| Wire::of(bit))
            }
            Operand::Place(Target::Element(element)) => element::wire(self, element, bit),
        }
    }
}
