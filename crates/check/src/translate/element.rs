//! Elements of arrays: every transition on an element reads the bits of the index that select it.

use smallvec::smallvec;

use super::subnet::Subnet;
use super::weaver::{Bit, Changes, VALUES};
use super::wire::{Wire, with};
use petril_lang::flat::{Element, Target};
use petril_lang::semantics::VarId;

/// Elements that the index can select, each with the bits of the index that select it.
fn choices(subnet: &Subnet<'_>, element: Element) -> Vec<(VarId, Changes)> {
    let index = subnet.variable(element.index);
    let value = |number: usize, bit: usize| number.checked_shr(bit as u32).unwrap_or(0) & 1 == 1;
    let can_be = |number: &usize| number.checked_shr(index.len() as u32).unwrap_or(0) == 0;
    let choice = |number: usize| {
        let given = index.iter().enumerate().map(|(bit, &place)| (place, value(number, bit), value(number, bit)));
        (element.at(number), given.collect())
    };
    (0..element.length).filter(can_be).map(choice).collect()
}

/// Bit of the element that the index selects. A bit that no element stores is 0, whatever the index is.
pub fn wire(subnet: &Subnet<'_>, element: Element, bit: u32) -> Wire {
    if element.all().all(|variable| subnet.variable(variable).len() <= bit as usize) {
        return Wire::fixed(false);
    }
    let mut readings = Vec::new();
    for (variable, given) in choices(subnet, element) {
        match subnet.variable(variable).get(bit as usize) {
            Some(&place) => readings.extend(VALUES.map(|value| (value, with((place, value, value), &given)))),
            None => readings.push((false, given)),
        }
    }
    Wire(readings)
}

/// Bits that a target can be, for each position: each with the bits of the index that select it, or `None` if the bit
/// is not stored.
pub fn targets(subnet: &Subnet<'_>, target: Target) -> Vec<Vec<(Option<Bit>, Changes)>> {
    let choices = match target {
        Target::Variable(variable) => vec![(variable, smallvec![])],
        Target::Element(element) => choices(subnet, element),
    };
    let most = choices.iter().map(|(variable, _)| subnet.variable(*variable).len()).max().unwrap_or(0);
    let at = |position: usize| {
        let bits =
            choices.iter().map(|(variable, given)| (subnet.variable(*variable).get(position).copied(), given.clone()));
        bits.collect()
    };
    (0..most).map(at).collect()
}
