//! Arithmetic gates: numbers are rows of wires, the least significant bit first.

use super::gates::{Network, Wire};
use crate::flat::Function;
use crate::semantics::{Kind, Type};

/// Wires of a constant bit pattern.
pub(super) fn constant(pattern: u64, width: usize) -> Vec<Wire> {
    (0..width).map(|bit| Wire::constant(pattern.checked_shr(bit as u32).is_some_and(|rest| rest & 1 == 1))).collect()
}

/// Bits truncated to a width, or extended by 0.
pub(super) fn resized(bits: &[Wire], width: usize) -> Vec<Wire> {
    (0..width).map(|bit| bits.get(bit).copied().unwrap_or(Wire::FALSE)).collect()
}

/// Complement of every bit, if `negated`.
pub(super) fn complement(bits: &[Wire], negated: bool) -> Vec<Wire> {
    bits.iter().map(|&bit| if negated { !bit } else { bit }).collect()
}

/// Ripple-carry adder: returns the sum, the carry into its last bit, and the carry out.
pub(super) fn add(network: &mut Network, a: &[Wire], b: &[Wire], mut carry: Wire) -> (Vec<Wire>, Wire, Wire) {
    let mut into = carry;
    let mut sum = Vec::with_capacity(a.len());
    for (&a, &b) in a.iter().zip(b) {
        into = carry;
        let half = network.xor(a, b);
        sum.push(network.xor(half, carry));
        carry = network.choose(half, carry, a);
    }
    (sum, into, carry)
}

/// Sum or difference of two numbers modulo 2^width, and whether it overflows the type.
pub(super) fn sum(network: &mut Network, ty: Type, a: &[Wire], b: &[Wire], minus: bool) -> (Vec<Wire>, Wire) {
    let b = complement(b, minus);
    let (sum, into, out) = add(network, a, &b, Wire::constant(minus));
    let overflow = match ty.kind {
        Kind::Bits => Wire::FALSE,
        Kind::Unsigned => network.xor(out, Wire::constant(minus)),
        Kind::Signed | Kind::Time => network.xor(into, out),
    };
    (sum, overflow)
}

/// Comparison a ≥ b.
fn at_least(network: &mut Network, ty: Type, a: &[Wire], b: &[Wire]) -> Wire {
    let (mut a, mut b) = (a.to_vec(), complement(b, true));
    if let (true, Some(a), Some(b)) = (ty.is_signed(), a.last_mut(), b.last_mut()) {
        (*a, *b) = (!*a, !*b);
    }
    add(network, &a, &b, Wire::TRUE).2
}

/// Equality of two bit patterns.
pub(super) fn equal(network: &mut Network, a: &[Wire], b: &[Wire]) -> Wire {
    let same: Vec<Wire> = a.iter().zip(b).map(|(&a, &b)| !network.xor(a, b)).collect();
    network.all(same)
}

/// Comparison by a function; `None` if the function is not a comparison.
pub(super) fn compare(network: &mut Network, function: Function, ty: Type, a: &[Wire], b: &[Wire]) -> Option<Wire> {
    Some(match function {
        Function::Eq => equal(network, a, b),
        Function::Ne => !equal(network, a, b),
        Function::Ge => at_least(network, ty, a, b),
        Function::Lt => !at_least(network, ty, a, b),
        Function::Le => at_least(network, ty, b, a),
        Function::Gt => !at_least(network, ty, b, a),
        _ => return None,
    })
}

/// Range check lower ≤ a ≤ upper.
pub(super) fn is_between(network: &mut Network, ty: Type, a: &[Wire], lower: i128, upper: i128) -> Wire {
    if lower > ty.greatest() || upper < ty.least() {
        return Wire::FALSE;
    }
    let pattern = |number: i128| constant(ty.pattern(number), a.len());
    let from = if lower <= ty.least() { Wire::TRUE } else { at_least(network, ty, a, &pattern(lower)) };
    let to = if upper >= ty.greatest() { Wire::TRUE } else { at_least(network, ty, &pattern(upper), a) };
    network.and(from, to)
}

/// Bit pattern shifted or rotated by a constant distance; `None` for other functions.
pub(super) fn shift(function: Function, bits: &[Wire], distance: u64) -> Option<Vec<Wire>> {
    let width = bits.len() as u64;
    let from = |source: &dyn Fn(u64) -> Option<u64>| -> Vec<Wire> {
        (0..width).map(|bit| source(bit).map_or(Wire::FALSE, |bit| bits[bit as usize])).collect()
    };
    Some(match function {
        Function::Shl => from(&|bit| bit.checked_sub(distance)),
        Function::Shr => from(&|bit| bit.checked_add(distance).filter(|&bit| bit < width)),
        Function::Rol => from(&|bit| Some((bit + width - distance % width) % width)),
        Function::Ror => from(&|bit| Some((bit + distance % width) % width)),
        _ => return None,
    })
}

/// Conversion of a number to another type, and whether it overflows that type.
pub(super) fn convert(network: &mut Network, from: Type, to: Type, bits: &[Wire]) -> (Vec<Wire>, Wire) {
    if to.is_bool() {
        return (vec![network.any(bits.iter().copied())], Wire::FALSE);
    }
    let sign = bits.last().copied().filter(|_| from.is_signed()).unwrap_or(Wire::FALSE);
    let extended = |width: u32| (0..width as usize).map(|bit| bits.get(bit).copied().unwrap_or(sign));
    let pattern: Vec<Wire> = extended(to.width).collect();
    if !to.overflows_from(from) {
        return (pattern, Wire::FALSE);
    }
    // All bits from the target type's sign on must equal the number's sign; for an unsigned type they must be 0.
    let first = if to.is_signed() { to.width as usize - 1 } else { to.width as usize };
    let expected = if to.is_signed() { sign } else { Wire::FALSE };
    let above: Vec<Wire> =
        extended(from.width.max(to.width) + 1).skip(first).map(|bit| network.xor(bit, expected)).collect();
    (pattern, network.any(above))
}
