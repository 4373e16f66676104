//! `ST x`, `STN x`: the variable takes the value of the current result.

use super::weaver::{Subnet, VALUES};
use crate::semantics::VarId;

pub fn translate(subnet: &mut Subnet<'_>, negated: bool, variable: VarId) {
    let (result, bit) = (subnet.result(), subnet.variable(variable));
    for value in VALUES {
        for old in VALUES {
            subnet.step(subnet.next(), &[(&result, value, value), (&bit, old, value ^ negated)]);
        }
    }
}
