//! `JMP`, `JMPC`, `JMPCN`: the control token goes to the target's place or to the next line's.

use super::weaver::{Subnet, VALUES};
use crate::semantics::Condition;

pub fn translate(subnet: &mut Subnet<'_>, condition: Condition, target: usize) {
    let jumps_on = match condition {
        Condition::Always => return subnet.step(target, &[]),
        Condition::IfTrue => true,
        Condition::IfFalse => false,
    };
    let result = subnet.result();
    for value in VALUES {
        let to = if value == jumps_on { target } else { subnet.next() };
        subnet.step(to, &[(&result, value, value)]);
    }
}
