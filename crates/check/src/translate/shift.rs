//! `SHL x`, `SHR x`, `ROL x`, `ROR x`: by a constant at once, by a variable in one stage for each bit of the distance
//! (barrel shifter).

use smallvec::smallvec;

use super::register::clear;
use super::subnet::{Step, Subnet};
use super::walk::Stage;
use super::weaver::{Bit, VALUES};
use super::wire::Wire;
use petril_lang::flat::{Function, Operand, Target};
use petril_lang::semantics::Type;
use petril_net::net::PlaceId;

/// Translates a shift. The operand may be of any type; complemented it has as many bits as the current result.
pub fn translate(subnet: &mut Subnet<'_>, function: Function, ty: Type, negated: bool, operand: Operand) {
    let width = if negated { ty.width } else { operand_width(subnet, operand) };
    let distance: Vec<Wire> = (0..width).map(|bit| subnet.wire(operand, bit)).collect();
    let distance = distance.into_iter().map(|wire| if negated { wire.complement() } else { wire }).collect();
    by(subnet, function, ty, distance);
}

fn operand_width(subnet: &Subnet<'_>, operand: Operand) -> u32 {
    let bits = match operand {
        Operand::Constant(_) => 64,
        Operand::Place(Target::Variable(variable)) => subnet.variable(variable).len(),
        Operand::Place(Target::Element(element)) => {
            element.all().map(|variable| subnet.variable(variable).len()).max().unwrap_or(0)
        }
    };
    bits as u32
}

fn by(subnet: &mut Subnet<'_>, function: Function, ty: Type, mut distance: Vec<Wire>) {
    let (mut at, next, bits) = (subnet.here(), subnet.next(), subnet.result(ty.width));
    let stages = ty.width.trailing_zeros() as usize;
    let mut far = distance.split_off(stages.min(distance.len()));
    if rotates(function) {
        // Widths are powers of two, so the remaining bits are the distance modulo the width.
        far.clear();
    }
    far.retain(|wire| wire.known() != Some(false));
    let known = distance.iter().enumerate().map(|(stage, wire)| wire.known().map(|value| usize::from(value) << stage));
    if far.iter().any(|wire| wire.known().is_some()) {
        return clear(subnet, at, next, &bits);
    }
    if let Some(distance) = known.sum::<Option<usize>>().filter(|_| far.is_empty()) {
        return once(subnet, function, at, next, &bits, distance);
    }
    if !far.is_empty() {
        let (near, zero) = (subnet.within(), subnet.within());
        subnet.walk(at, (0, false), |_, &(position, is_far)| match far.get(position) {
            _ if is_far => Stage::Leave(zero),
            None => Stage::Leave(near),
            Some(wire) => Stage::Branch(wire.branch(|value| (position + 1, value))),
        });
        clear(subnet, zero, next, &bits);
        at = near;
    }
    if distance.is_empty() {
        return subnet.step(at, next, &[]);
    }
    for (stage, wire) in distance.iter().enumerate() {
        let to = if stage + 1 == distance.len() { next } else { subnet.within() };
        let moves = subnet.within();
        for (value, given) in &wire.0 {
            subnet.step(at, if *value { moves } else { to }, given);
        }
        once(subnet, function, moves, to, &bits, 1 << stage);
        at = to;
    }
}

fn rotates(function: Function) -> bool {
    matches!(function, Function::Rol | Function::Ror)
}

/// Shifts by a constant distance. Distances of at least the width leave 0.
pub fn once(subnet: &mut Subnet<'_>, function: Function, from: PlaceId, to: PlaceId, bits: &[Bit], distance: usize) {
    let width = bits.len();
    match function {
        _ if distance == 0 => subnet.step(from, to, &[]),
        Function::Rol => rotate(subnet, from, to, bits, distance % width),
        Function::Ror => rotate(subnet, from, to, bits, width - distance % width),
        _ => {
            let source = |position: usize| {
                let source = if function == Function::Shl {
                    position.checked_sub(distance)
                } else {
                    position.checked_add(distance).filter(|&source| source < width)
                };
                source.map_or(Wire::fixed(false), |source| Wire::of(bits[source]))
            };
            // A bit must be read before it is written.
            let up = 0..width;
            let order: Vec<usize> = if function == Function::Shl { up.rev().collect() } else { up.collect() };
            let steps: Vec<Step> = order.into_iter().map(|position| source(position).assign(bits[position])).collect();
            subnet.chain(from, to, &steps);
        }
    }
}

/// Rotates to the left. Each cycle of positions is passed through once, while control holds the next value.
fn rotate(subnet: &mut Subnet<'_>, from: PlaceId, to: PlaceId, bits: &[Bit], distance: usize) {
    #[derive(Clone, PartialEq, Eq, Hash)]
    enum State {
        /// Before the cycle that begins at this position.
        Cycle(usize),
        /// In a cycle, with the value to be stored at a position.
        Put { cycle: usize, position: usize, value: bool },
    }
    let width = bits.len();
    // The greatest common divisor of distance and width, since widths are powers of two.
    let cycles = 1 << (distance | width).trailing_zeros();
    subnet.walk(from, State::Cycle(0), |_, state| match *state {
        State::Cycle(cycle) if cycle == cycles || cycles == width => Stage::Leave(to),
        State::Cycle(cycle) => {
            let position = (cycle + distance) % width;
            Stage::Branch(Wire::of(bits[cycle]).branch(|value| State::Put { cycle, position, value }))
        }
        State::Put { cycle, position, value } => {
            let after = |old| {
                if position == cycle {
                    State::Cycle(cycle + 1)
                } else {
                    State::Put { cycle, position: (position + distance) % width, value: old }
                }
            };
            Stage::Branch(VALUES.map(|old| (smallvec![(bits[position], old, value)], after(old))).into())
        }
    });
}
