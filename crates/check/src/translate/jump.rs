//! `JMP`, `JMPC`, `JMPCN`: the control token goes to the target's place or to that of the next line.

use super::subnet::Subnet;
use super::weaver::VALUES;
use petril_lang::semantics::Condition;

pub fn translate(subnet: &mut Subnet<'_>, condition: Condition, target: usize) {
    let (here, target) = (subnet.here(), subnet.at_line(target));
    let jumps_on = match condition {
        Condition::Always => return subnet.step(here, target, &[]),
        Condition::IfTrue => true,
        Condition::IfFalse => false,
    };
    let result = subnet.truth();
    for value in VALUES {
        let to = if value == jumps_on { target } else { subnet.next() };
        subnet.step(here, to, &[(result, value, value)]);
    }
}
