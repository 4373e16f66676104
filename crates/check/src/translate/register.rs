//! Operations on whole registers for multiplication and division: copying, negating, setting to 0.

use smallvec::smallvec;

use super::subnet::{Step, Subnet};
use super::walk::Stage;
use super::weaver::{Bit, VALUES};
use super::wire::{Wire, with};
use petril_net::net::PlaceId;

/// `bits := 0`
pub fn clear(subnet: &mut Subnet<'_>, from: PlaceId, to: PlaceId, bits: &[Bit]) {
    let steps: Vec<Step> = bits.iter().map(|&bit| Wire::fixed(false).assign(bit)).collect();
    subnet.chain(from, to, &steps);
}

/// `bits := wires`, where the bits are 0 before.
pub fn fill(subnet: &mut Subnet<'_>, from: PlaceId, to: PlaceId, bits: &[Bit], wires: &[Wire]) {
    let step =
        |(&bit, wire): (&Bit, &Wire)| wire.0.iter().map(|(value, given)| with((bit, false, *value), given)).collect();
    let steps: Vec<Step> = bits.iter().zip(wires).map(step).collect();
    subnet.chain(from, to, &steps);
}

/// `bits := -wires`, where the bits are 0 before: the bits up to the lowest 1 stay, those above are complemented.
pub fn fill_negated(subnet: &mut Subnet<'_>, from: PlaceId, to: PlaceId, bits: &[Bit], wires: &[Wire]) {
    subnet.walk(from, (0, false), |_, &(position, seen)| {
        let (Some(&bit), Some(wire)) = (bits.get(position), wires.get(position)) else { return Stage::Leave(to) };
        let branches =
            wire.0.iter().map(|(value, given)| (with((bit, false, value ^ seen), given), (position + 1, seen | value)));
        Stage::Branch(branches.collect())
    });
}

/// `bits := -bits`
pub fn negate(subnet: &mut Subnet<'_>, from: PlaceId, to: PlaceId, bits: &[Bit]) {
    subnet.walk(from, (0, false), |_, &(position, seen)| {
        let Some(&bit) = bits.get(position) else { return Stage::Leave(to) };
        let branches = VALUES.map(|value| (smallvec![(bit, value, value ^ seen)], (position + 1, seen | value)));
        Stage::Branch(branches.into())
    });
}
