//! `S x`, `R x`: sets the variable to 1 or 0 if the current result is 1, and leaves it if it is 0.

use smallvec::smallvec;

use super::element::targets;
use super::subnet::{Step, Subnet};
use super::weaver::VALUES;
use petril_lang::flat::Target;

pub fn translate(subnet: &mut Subnet<'_>, target: Target, value: bool) {
    let result = subnet.truth();
    let mut step = Step::new();
    for (bit, given) in targets(subnet, target).into_iter().flatten() {
        let Some(bit) = bit else { continue };
        for old in VALUES {
            for (condition, new) in [(false, old), (true, value)] {
                let mut changes = smallvec![(result, condition, condition), (bit, old, new)];
                changes.extend_from_slice(&given);
                step.push(changes);
            }
        }
    }
    subnet.chain(subnet.here(), subnet.next(), &[step]);
}
