//! `ADD x`, `SUB x`: ripple-carry adder from the lowest bit, the carry in the control place. A difference is the sum
//! with the complement of the operand and a carry in.

use super::subnet::Subnet;
use super::walk::Stage;
use super::weaver::{Bit, Changes, VALUES};
use super::wire::{Wire, with};
use petril_lang::flat::Hazard;
use petril_lang::semantics::{Kind, Type};

/// Full adder: sum and carry.
pub fn full(a: bool, b: bool, carry: bool) -> (bool, bool) {
    (a ^ b ^ carry, u8::from(a) + u8::from(b) + u8::from(carry) >= 2)
}

/// Alternatives of `bit := bit + wire + carry`: the changes, and both carries, in and out.
pub fn alternatives(bit: Bit, wire: &Wire, carry: bool) -> Vec<(Changes, [bool; 2])> {
    let mut alternatives = Vec::with_capacity(2 * wire.0.len());
    for old in VALUES {
        for (value, given) in &wire.0 {
            let (sum, out) = full(old, *value, carry);
            alternatives.push((with((bit, old, sum), given), [carry, out]));
        }
    }
    alternatives
}

/// Whether a sum or difference is not a number of the type, by the carries into and out of the highest bit.
pub fn overflows(ty: Type, subtracts: bool, [carry_in, carry_out]: [bool; 2]) -> bool {
    match ty.kind {
        Kind::Bits => false,
        Kind::Unsigned => carry_out != subtracts,
        Kind::Signed | Kind::Time => carry_in != carry_out,
    }
}

#[derive(Clone, PartialEq, Eq, Hash)]
enum State {
    /// Before this bit, with this carry.
    Bit(usize, bool),
    /// After the highest bit, with these carries into and out of it.
    Done([bool; 2]),
}

pub fn translate(subnet: &mut Subnet<'_>, ty: Type, subtracts: bool, wires: Vec<Wire>) {
    let wires: Vec<Wire> = if subtracts { wires.into_iter().map(Wire::complement).collect() } else { wires };
    let (here, next, result) = (subnet.here(), subnet.next(), subnet.result(ty.width));
    let after = |bit: usize, carries: [bool; 2]| {
        if bit + 1 == wires.len() { State::Done(carries) } else { State::Bit(bit + 1, carries[1]) }
    };
    subnet.walk(here, State::Bit(0, subtracts), |subnet, state| match *state {
        // If operand and carry are equal, neither the bit nor the carry changes.
        State::Bit(bit, carry) if wires[bit].known() == Some(carry) => Stage::Same(after(bit, [carry; 2])),
        State::Bit(bit, carry) => {
            let alternatives = alternatives(result[bit], &wires[bit], carry).into_iter();
            Stage::Branch(alternatives.map(|(changes, carries)| (changes, after(bit, carries))).collect())
        }
        State::Done(carries) if overflows(ty, subtracts, carries) => Stage::Leave(subnet.hazard(Hazard::Overflow)),
        State::Done(_) => Stage::Leave(next),
    });
    subnet.after_hazard(Hazard::Overflow, next);
}
