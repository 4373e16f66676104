//! `GT x`, `GE x`, `EQ x`, `NE x`, `LE x`, `LT x`: from the highest bit down to the first that differs.

use std::cmp::Ordering;

use smallvec::smallvec;

use super::subnet::Subnet;
use super::walk::Stage;
use super::weaver::{Bit, Changes, VALUES};
use super::wire::{Wire, with};
use petril_lang::flat::Function;
use petril_lang::semantics::Type;

/// Whether an ordering of current result and operand makes the comparison true.
fn truth(function: Function, ordering: Ordering) -> bool {
    match function {
        Function::Gt => ordering.is_gt(),
        Function::Ge => ordering.is_ge(),
        Function::Eq => ordering.is_eq(),
        Function::Ne => ordering.is_ne(),
        Function::Le => ordering.is_le(),
        _ => ordering.is_lt(),
    }
}

/// Alternatives of a bit and a wire, each with their ordering; a sign bit is ordered the other way round.
pub fn alternatives(bit: Bit, wire: &Wire, sign: bool) -> Vec<(Changes, Ordering)> {
    let mut alternatives = Vec::with_capacity(2 * wire.0.len());
    for own in VALUES {
        for (value, given) in &wire.0 {
            let ordering = if sign { value.cmp(&own) } else { own.cmp(value) };
            alternatives.push((with((bit, own, own), given), ordering));
        }
    }
    alternatives
}

#[derive(Clone, PartialEq, Eq, Hash)]
enum State {
    /// Bits above this one are all equal.
    Equal(usize),
    /// The truth value of the comparison is known.
    Known(bool),
    /// The truth value is in the current result.
    Done,
}

pub fn translate(subnet: &mut Subnet<'_>, function: Function, ty: Type, wires: &[Wire]) {
    let (here, next, result) = (subnet.here(), subnet.next(), subnet.result(ty.width));
    subnet.walk(here, State::Equal(wires.len() - 1), |_, state| match *state {
        State::Equal(0) => {
            // The lowest bit also takes the truth value.
            let mut branches = alternatives(result[0], &wires[0], ty.is_signed() && wires.len() == 1);
            branches.iter_mut().for_each(|(changes, ordering)| changes[0].2 = truth(function, *ordering));
            Stage::Branch(branches.into_iter().map(|(changes, _)| (changes, State::Done)).collect())
        }
        State::Equal(bit) => {
            let branches = alternatives(result[bit], &wires[bit], ty.is_signed() && bit + 1 == wires.len());
            let state = |ordering: Ordering| match ordering {
                Ordering::Equal => State::Equal(bit - 1),
                _ => State::Known(truth(function, ordering)),
            };
            Stage::Branch(branches.into_iter().map(|(changes, ordering)| (changes, state(ordering))).collect())
        }
        State::Known(answer) => {
            Stage::Branch(VALUES.map(|old| (smallvec![(result[0], old, answer)], State::Done)).into())
        }
        State::Done => Stage::Leave(next),
    });
}
