//! `NOT`: the current result changes its value.

use super::weaver::{Subnet, VALUES};

pub fn translate(subnet: &mut Subnet<'_>) {
    let result = subnet.result();
    for value in VALUES {
        subnet.step(subnet.next(), &[(&result, value, !value)]);
    }
}
