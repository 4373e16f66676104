//! Range check of the current result; only the bits that can decide it are read.

use smallvec::smallvec;

use super::ranges::Block;
use super::subnet::{Step, Subnet};
use super::walk::Stage;
use super::weaver::VALUES;
use super::wire::Wire;
use petril_lang::flat::Hazard;
use petril_lang::semantics::Type;
use petril_net::net::PlaceId;

/// Translates a range check. A number outside goes through the place of the hazard; an index then becomes the least
/// one.
pub fn translate(subnet: &mut Subnet<'_>, ty: Type, (lower, upper): (i128, i128), hazard: Hazard) {
    let (here, next) = (subnet.here(), subnet.next());
    within(subnet, here, ty, (lower, upper), hazard, next);
    let Some(outside) = subnet.met(hazard) else { return };
    let pattern = ty.pattern(lower);
    let least = |(position, bit)| Wire::fixed(pattern >> position & 1 == 1).assign(bit);
    let steps: Vec<Step> = if hazard == Hazard::Index {
        subnet.result(ty.width).into_iter().enumerate().map(least).collect()
    } else {
        Vec::new()
    };
    subnet.chain(outside, next, &steps);
}

/// Adds a range check that leads to `inside` if the current result is in the range, and to the place of the hazard if
/// not.
pub fn within(
    subnet: &mut Subnet<'_>,
    from: PlaceId,
    ty: Type,
    (lower, upper): (i128, i128),
    hazard: Hazard,
    inside: PlaceId,
) {
    let result = subnet.result(ty.width);
    let start = Block::new(ty, ty.width, &[(lower, upper)]);
    subnet.walk(from, start, |subnet, block| match block.highest() {
        _ if block.is_empty() => Stage::Leave(subnet.hazard(hazard)),
        Some(highest) if !block.is_full() => {
            let bit = result[highest as usize];
            Stage::Branch(VALUES.map(|value| (smallvec![(bit, value, value)], block.half(value))).into())
        }
        _ => Stage::Leave(inside),
    });
}
