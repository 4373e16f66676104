//! `NOT`: complements every bit of the current result.

use smallvec::smallvec;

use super::subnet::{Step, Subnet};
use super::weaver::VALUES;
use petril_lang::semantics::Type;

pub fn translate(subnet: &mut Subnet<'_>, ty: Type) {
    let flip = |bit| VALUES.map(|value| smallvec![(bit, value, !value)]).into();
    let steps: Vec<Step> = subnet.result(ty.width).into_iter().map(flip).collect();
    subnet.chain(subnet.here(), subnet.next(), &steps);
}
