//! `MUL x`: shift and add, in the current result itself. Its bits are taken from the highest to the lowest; a 1 becomes
//! 0, and the operand is added from its position on. The bits above are already part of the product then.

use smallvec::smallvec;

use super::add::{alternatives, overflows};
use super::bound;
use super::register::{clear, fill, fill_negated, negate};
use super::shift;
use super::subnet::Subnet;
use super::walk::Stage;
use super::weaver::{Bit, Change, Changes, VALUES};
use super::wire::Wire;
use crate::translate::provenance::Register;
use petril_lang::flat::{Function, Hazard, Operand, Target};
use petril_lang::semantics::{Kind, Type};
use petril_net::net::PlaceId;

pub fn translate(subnet: &mut Subnet<'_>, ty: Type, negated: bool, operand: Operand) {
    let wires = subnet.wires(ty, negated, operand);
    if let Some(bits) = wires.iter().map(Wire::known).collect::<Option<Vec<bool>>>() {
        let pattern = bits.iter().rev().fold(0, |pattern, &bit| pattern << 1 | u64::from(bit));
        return constant(subnet, ty, pattern, &wires);
    }
    let (here, next, result) = (subnet.here(), subnet.next(), subnet.result(ty.width));
    let indexed = matches!(operand, Operand::Place(Target::Element(_)));
    let (rows, done) = (subnet.within(), subnet.within());
    let added = match ty.kind {
        Kind::Signed | Kind::Time => {
            let check = subnet.within();
            let added = magnitude(subnet, here, check, &result, &wires);
            fits(subnet, check, rows, &result, &added, true);
            added
        }
        _ => {
            let (check, bits) = if indexed { copy(subnet, here, ty, &wires) } else { (here, wires) };
            if ty.kind == Kind::Bits {
                subnet.step(check, rows, &[]);
            } else {
                fits(subnet, check, rows, &result, &bits, false);
            }
            bits
        }
    };
    let mark = (ty.kind != Kind::Bits).then(|| subnet.mark());
    add_up(subnet, rows, done, ty, &result, &added, mark);
    finish(subnet, done, next, ty, indexed, mark);
}

/// Copies the operand to its register; returns the place after that, and the register.
fn copy(subnet: &mut Subnet<'_>, from: PlaceId, ty: Type, wires: &[Wire]) -> (PlaceId, Vec<Wire>) {
    let to = subnet.within();
    let register = subnet.register(Register::Operand, ty.width);
    fill(subnet, from, to, &register, wires);
    (to, register.into_iter().map(Wire::of).collect())
}

/// Multiplies by a constant: an overflow is known before, and a power of two only shifts.
fn constant(subnet: &mut Subnet<'_>, ty: Type, pattern: u64, wires: &[Wire]) {
    let (next, result, factor) = (subnet.next(), subnet.result(ty.width), ty.number(pattern));
    let mut at = subnet.here();
    let bounds = match factor {
        _ if ty.kind == Kind::Bits => None,
        0 => None,
        // Truncation toward zero rounds both bounds to the inside.
        1.. => Some((ty.least() / factor, ty.greatest() / factor)),
        _ => Some((ty.greatest() / factor, ty.least() / factor)),
    };
    if let Some((lower, upper)) = bounds.filter(|&(lower, upper)| !(ty.least() >= lower && ty.greatest() <= upper)) {
        let inside = subnet.within();
        bound::within(subnet, at, ty, (lower, upper), Hazard::Overflow, inside);
        subnet.after_hazard(Hazard::Overflow, inside);
        at = inside;
    }
    match pattern {
        0 => clear(subnet, at, next, &result),
        _ if pattern.is_power_of_two() => {
            shift::once(subnet, Function::Shl, at, next, &result, pattern.trailing_zeros() as usize);
        }
        _ => add_up(subnet, at, next, ty, &result, wires, None),
    }
}

/// Replaces the current result by its magnitude, and stores the operand in its register, negated if the current result
/// was negative. The register has one bit more than the type. Returns its bits, the summand.
fn magnitude(subnet: &mut Subnet<'_>, from: PlaceId, to: PlaceId, result: &[Bit], wires: &[Wire]) -> Vec<Wire> {
    let register = subnet.register(Register::Operand, wires.len() as u32 + 1);
    let sign = wires.last().cloned();
    let extended: Vec<Wire> = wires.iter().cloned().chain(sign).collect();
    let [positive, negative, negated] = [(); 3].map(|()| subnet.within());
    if let Some(&sign) = result.last() {
        subnet.step(from, positive, &[(sign, false, false)]);
        subnet.step(from, negative, &[(sign, true, true)]);
    }
    fill(subnet, positive, to, &register, &extended);
    fill_negated(subnet, negative, negated, &register, &extended);
    negate(subnet, negated, to, result);
    register.into_iter().map(Wire::of).collect()
}

/// Marks an overflow if the operand, shifted to the highest 1 of the current result, is too long for the type. If it is
/// not, no summand is.
fn fits(subnet: &mut Subnet<'_>, from: PlaceId, to: PlaceId, result: &[Bit], added: &[Wire], signed: bool) {
    #[derive(Clone, PartialEq, Eq, Hash)]
    enum State {
        /// Bits of the current result above this one are all 0.
        Leading(usize),
        /// Bits of the operand from this one on should all have the same value.
        Same(usize),
        /// Bits of the operand from this one on should all have this value.
        All(usize, bool),
        TooLong,
        Done,
    }
    let (width, mark) = (result.len(), subnet.mark());
    let all = |bit: usize, expected: bool| if bit < added.len() { State::All(bit, expected) } else { State::Done };
    subnet.walk(from, State::Leading(width - 1), |_, state| match *state {
        State::Leading(bit) => {
            let one = if signed { State::Same(width - 1 - bit) } else { all(width - bit, false) };
            let zero = if bit == 0 { State::Done } else { State::Leading(bit - 1) };
            Stage::Branch(Wire::of(result[bit]).branch(|value| if value { one.clone() } else { zero.clone() }))
        }
        State::Same(bit) => Stage::Branch(added[bit].branch(|value| all(bit + 1, value))),
        State::All(bit, expected) => Stage::Branch(
            added[bit].branch(|value| if value == expected { all(bit + 1, expected) } else { State::TooLong }),
        ),
        State::TooLong => Stage::Branch(vec![(smallvec![(mark, false, true)], State::Done)]),
        State::Done => Stage::Leave(to),
    });
}

/// Adds up the operand at the positions of all bits of the current result that are 1. An overflow is marked.
fn add_up(
    subnet: &mut Subnet<'_>,
    from: PlaceId,
    to: PlaceId,
    ty: Type,
    result: &[Bit],
    added: &[Wire],
    mark: Option<Bit>,
) {
    #[derive(Clone, PartialEq, Eq, Hash)]
    enum State {
        /// Before this bit of the current result.
        Row(usize),
        /// Operand at position `row`, whose bit is added with a carry.
        Add {
            row: usize,
            bit: usize,
            carry: bool,
        },
        Done,
    }
    let width = result.len();
    let below = |row: usize| if row == 0 { State::Done } else { State::Row(row - 1) };
    let behind = |row: usize, bit: usize, carry: bool| {
        if row + bit + 1 == width { below(row) } else { State::Add { row, bit: bit + 1, carry } }
    };
    subnet.walk(from, State::Row(width - 1), |_, state| match *state {
        State::Row(row) => {
            let mut branches = vec![(smallvec![(result[row], false, false)], below(row))];
            for (value, given) in &added[0].0 {
                let changes = super::wire::with((result[row], true, *value), given);
                branches.push((changes, behind(row, 0, false)));
            }
            Stage::Branch(branches)
        }
        State::Add { row, bit, carry } if added[bit].known() == Some(carry) => Stage::Same(behind(row, bit, carry)),
        State::Add { row, bit, carry } => {
            let mut branches = Vec::new();
            for (changes, carries) in alternatives(result[row + bit], &added[bit], carry) {
                let after = behind(row, bit, carries[1]);
                let highest = row + bit + 1 == width;
                match mark.filter(|_| highest && overflows(ty, false, carries)) {
                    Some(mark) => branches.extend(marked(&changes, mark).map(|changes| (changes, after.clone()))),
                    None => branches.push((changes, after)),
                }
            }
            Stage::Branch(branches)
        }
        State::Done => Stage::Leave(to),
    });
}

/// Changes that also set the mark, whatever its old value is.
fn marked(changes: &[Change], mark: Bit) -> [Changes; 2] {
    VALUES.map(|old| {
        let mut changes = Changes::from_slice(changes);
        changes.push((mark, old, true));
        changes
    })
}

/// Resets the registers to 0; a marked overflow goes through the place of the hazard.
fn finish(subnet: &mut Subnet<'_>, from: PlaceId, next: PlaceId, ty: Type, indexed: bool, mark: Option<Bit>) {
    let copied = if ty.is_signed() { ty.width + 1 } else { ty.width * u32::from(indexed) };
    let register = subnet.register(Register::Operand, copied);
    let Some(mark) = mark else { return clear(subnet, from, next, &register) };
    let judged = if copied == 0 { from } else { subnet.within() };
    if copied > 0 {
        clear(subnet, from, judged, &register);
    }
    let overflow = subnet.hazard(Hazard::Overflow);
    subnet.step(judged, next, &[(mark, false, false)]);
    subnet.step(judged, overflow, &[(mark, true, false)]);
    subnet.after_hazard(Hazard::Overflow, next);
}
