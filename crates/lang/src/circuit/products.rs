//! Gates for products, quotients, and shifts by a computed distance, which take many.

use super::gates::{Network, Wire};
use super::numbers::{add, complement, constant, resized};
use crate::flat::Function;
use crate::semantics::{Kind, Type};

/// Product of two numbers modulo 2^width, and whether it overflows the type.
pub(super) fn product(network: &mut Network, ty: Type, a: &[Wire], b: &[Wire]) -> (Vec<Wire>, Wire) {
    let width = a.len();
    // Modulo 2^(2 width), sign-extended numbers are multiplied like unsigned ones.
    let wide = if ty.kind == Kind::Bits { width } else { 2 * width };
    let (a, b) = (extended(ty, a, wide), extended(ty, b, wide));
    let mut product = vec![Wire::FALSE; wide];
    for (position, &bit) in b.iter().enumerate() {
        let row: Vec<Wire> = a[..wide - position].iter().map(|&a| network.and(a, bit)).collect();
        let sum = add(network, &product[position..], &row, Wire::FALSE).0;
        product.truncate(position);
        product.extend(sum);
    }
    let above = product.split_off(width);
    let sign = if ty.is_signed() { product[width - 1] } else { Wire::FALSE };
    let differ: Vec<Wire> = above.into_iter().map(|bit| network.xor(bit, sign)).collect();
    (product, network.any(differ))
}

fn extended(ty: Type, bits: &[Wire], width: usize) -> Vec<Wire> {
    let sign = bits.last().copied().filter(|_| ty.is_signed()).unwrap_or(Wire::FALSE);
    (0..width).map(|bit| bits.get(bit).copied().unwrap_or(sign)).collect()
}

/// Result of a division; both numbers are 0 if the divisor is.
pub(super) struct Divided {
    pub(super) quotient: Vec<Wire>,
    pub(super) remainder: Vec<Wire>,
    /// Whether the quotient overflows the type.
    pub(super) overflow: Wire,
}

/// Quotient of two numbers, truncated toward zero, and remainder with the sign of the dividend.
pub(super) fn quotient(network: &mut Network, ty: Type, a: &[Wire], b: &[Wire]) -> Divided {
    let width = a.len();
    let sign = |bits: &[Wire]| bits.last().copied().filter(|_| ty.is_signed()).unwrap_or(Wire::FALSE);
    let (sign_a, sign_b) = (sign(a), sign(b));
    let (dividend, divisor) = (negated_if(network, sign_a, a), negated_if(network, sign_b, b));
    // Long division, from the highest bit.
    let divisor = resized(&divisor, width + 1);
    let mut remainder = vec![Wire::FALSE; width];
    let mut quotient = vec![Wire::FALSE; width];
    for position in (0..width).rev() {
        let mut rest = vec![dividend[position]];
        rest.extend(&remainder);
        let (less, _, fits) = add(network, &rest, &complement(&divisor, true), Wire::TRUE);
        quotient[position] = fits;
        remainder = (0..width).map(|bit| network.choose(fits, less[bit], rest[bit])).collect();
    }
    let by_zero = !network.any(b.iter().copied());
    let differ = network.xor(sign_a, sign_b);
    // -2^(width - 1) / -1
    let overflow = match ty.is_signed() {
        true => network.and(!differ, quotient[width - 1]),
        false => Wire::FALSE,
    };
    let (quotient, remainder) = (negated_if(network, differ, &quotient), negated_if(network, sign_a, &remainder));
    let mut unless_by_zero =
        |bits: &[Wire]| -> Vec<Wire> { bits.iter().map(|&bit| network.and(bit, !by_zero)).collect() };
    let (quotient, remainder) = (unless_by_zero(&quotient), unless_by_zero(&remainder));
    Divided { quotient, remainder, overflow: network.and(overflow, !by_zero) }
}

fn negated_if(network: &mut Network, condition: Wire, bits: &[Wire]) -> Vec<Wire> {
    let turned: Vec<Wire> = bits.iter().map(|&bit| network.xor(bit, condition)).collect();
    add(network, &turned, &constant(0, bits.len()), condition).0
}

/// Barrel shifter: bit pattern shifted or rotated by a computed distance.
pub(super) fn shift(network: &mut Network, function: Function, bits: &[Wire], distance: &[Wire]) -> Vec<Wire> {
    // Widths are powers of 2, so a rotation depends only on the low bits of the distance.
    let width = bits.len();
    let stages = width.trailing_zeros() as usize;
    let mut bits = bits.to_vec();
    for (stage, &by) in distance.iter().enumerate().take(stages) {
        let step = 1 << stage;
        bits = (0..width)
            .map(|bit| {
                let from = match function {
                    Function::Shl => bit.checked_sub(step),
                    Function::Shr => Some(bit + step).filter(|&from| from < width),
                    Function::Rol => Some((bit + width - step) % width),
                    _ => Some((bit + step) % width),
                };
                network.choose(by, from.map_or(Wire::FALSE, |from| bits[from]), bits[bit])
            })
            .collect();
    }
    if matches!(function, Function::Shl | Function::Shr) {
        let beyond = network.any(distance.iter().skip(stages).copied());
        bits = bits.into_iter().map(|bit| network.and(bit, !beyond)).collect();
    }
    bits
}
