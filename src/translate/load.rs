//! `LD x`, `LDN x`: the current result takes the operand's value.

use super::weaver::{Subnet, VALUES};
use crate::flat::Operand;

pub fn translate(subnet: &mut Subnet<'_>, negated: bool, operand: Operand) {
    let result = subnet.result();
    for (value, bit) in subnet.readings(operand) {
        for old in VALUES {
            let read = bit.iter().map(|bit| (bit, value, value));
            let changes: Vec<_> = std::iter::once((&result, old, value ^ negated)).chain(read).collect();
            subnet.step(subnet.next(), &changes);
        }
    }
}
