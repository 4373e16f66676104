//! `S x`, `R x`: the variable becomes 1 or 0 if the current result is 1, and keeps its value if it is 0.

use super::weaver::{Subnet, VALUES};
use crate::semantics::VarId;

pub fn translate(subnet: &mut Subnet<'_>, variable: VarId, target: bool) {
    let (result, bit) = (subnet.result(), subnet.variable(variable));
    for old in VALUES {
        subnet.step(subnet.next(), &[(&result, false, false), (&bit, old, old)]);
        subnet.step(subnet.next(), &[(&result, true, true), (&bit, old, target)]);
    }
}
