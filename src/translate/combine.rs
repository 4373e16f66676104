//! `AND x`, `OR x`, `XOR x` and their N forms: one transition for each pair of current result and operand.

use super::weaver::{Subnet, VALUES};
use crate::flat::{Function, Operand};

/// The function's table: its value for (current result, operand) = 00, 01, 10, 11.
fn table(function: Function) -> [bool; 4] {
    match function {
        Function::And => [false, false, false, true],
        Function::Or => [false, true, true, true],
        Function::Xor => [false, true, true, false],
        _ => [false; 4],
    }
}

pub fn translate(subnet: &mut Subnet<'_>, function: Function, negated: bool, operand: Operand) {
    let (result, table) = (subnet.result(), table(function));
    for old in VALUES {
        for (value, bit) in subnet.readings(operand) {
            let new = table[2 * usize::from(old) + usize::from(value ^ negated)];
            let read = bit.iter().map(|bit| (bit, value, value));
            let changes: Vec<_> = std::iter::once((&result, old, new)).chain(read).collect();
            subnet.step(subnet.next(), &changes);
        }
    }
}
