//! `DIV x`, `MOD x`: long division of magnitudes. The current result becomes the remainder; from the highest position
//! at which the divisor fits down to 0, the divisor is subtracted where it is not greater, and the quotient gets a 1
//! there.

use std::cmp::Ordering;

use smallvec::smallvec;

use super::add;
use super::compare;
use super::register::{clear, fill, fill_negated, negate};
use super::subnet::{Step, Subnet};
use super::walk::Stage;
use super::weaver::{Bit, VALUES};
use super::wire::{Wire, with};
use crate::translate::provenance::Register;
use petril_lang::flat::{Hazard, Operand, Target};
use petril_lang::semantics::Type;
use petril_net::net::PlaceId;

/// Division under construction.
struct Division {
    ty: Type,
    /// Whether the result is the remainder (`MOD`).
    modulo: bool,
    result: Vec<Bit>,
    /// Divisor as given.
    given: Vec<Wire>,
    /// Magnitude of the divisor.
    divisor: Vec<Wire>,
    /// Register that holds the magnitude; empty if none is needed.
    register: Vec<Bit>,
}

pub fn translate(subnet: &mut Subnet<'_>, ty: Type, modulo: bool, negated: bool, operand: Operand) {
    let given = subnet.wires(ty, negated, operand);
    if given.iter().all(|wire| wire.known() == Some(false)) {
        return by_zero(subnet, ty);
    }
    let known = given.iter().all(|wire| wire.known().is_some());
    let signed = ty.is_signed();
    let copies = !known && (signed || matches!(operand, Operand::Place(Target::Element(_))));
    let register = subnet.register(Register::Operand, if copies { ty.width } else { 0 });
    let divisor = match () {
        () if copies => register.iter().map(|&bit| Wire::of(bit)).collect(),
        () if signed => magnitude(ty, &given),
        () => given.clone(),
    };
    let division = Division { ty, modulo, result: subnet.result(ty.width), given, divisor, register };

    let mut at = subnet.here();
    if copies {
        at = division.take_divisor(subnet, at);
    }
    if signed {
        at = division.take_dividend(subnet, at);
    }
    let done = subnet.within();
    division.divide(subnet, at, done);
    division.after_zero(subnet);
    division.finish(subnet, done);
}

/// Translates a division by a constant 0.
fn by_zero(subnet: &mut Subnet<'_>, ty: Type) {
    let hazard = subnet.hazard(Hazard::DivisionByZero);
    subnet.step(subnet.here(), hazard, &[]);
    clear(subnet, hazard, subnet.next(), &subnet.result(ty.width));
}

/// Magnitude of a constant.
fn magnitude(ty: Type, given: &[Wire]) -> Vec<Wire> {
    let pattern = given.iter().rev().fold(0, |pattern, wire| pattern << 1 | u64::from(wire.known() == Some(true)));
    let magnitude = ty.number(pattern).unsigned_abs();
    (0..ty.width).map(|bit| Wire::fixed(magnitude >> bit & 1 == 1)).collect()
}

impl Division {
    /// Stores the magnitude of the divisor in the register.
    fn take_divisor(&self, subnet: &mut Subnet<'_>, from: PlaceId) -> PlaceId {
        let to = subnet.within();
        let Some(sign) = self.given.last().filter(|_| self.ty.is_signed()) else {
            fill(subnet, from, to, &self.register, &self.given);
            return to;
        };
        for value in VALUES {
            let readings: Vec<_> = sign.0.iter().filter(|(read, _)| *read == value).collect();
            if readings.is_empty() {
                continue;
            }
            let begin = subnet.within();
            readings.iter().for_each(|(_, given)| subnet.step(from, begin, given));
            let take = if value { fill_negated } else { fill };
            take(subnet, begin, to, &self.register, &self.given);
        }
        to
    }

    /// Replaces the current result by its magnitude; the mark remembers that it was negative.
    fn take_dividend(&self, subnet: &mut Subnet<'_>, from: PlaceId) -> PlaceId {
        let (mark, sign) = (subnet.mark(), self.result[self.result.len() - 1]);
        let [negative, to] = [(); 2].map(|()| subnet.within());
        subnet.step(from, to, &[(sign, false, false)]);
        subnet.step(from, negative, &[(sign, true, true), (mark, false, true)]);
        negate(subnet, negative, to, &self.result);
        to
    }

    /// Replaces the current result by the remainder, and collects the quotient if it is the result.
    fn divide(&self, subnet: &mut Subnet<'_>, from: PlaceId, to: PlaceId) {
        #[derive(Clone, PartialEq, Eq, Hash)]
        enum State {
            /// Bits of the divisor above this one are all 0.
            Leading(usize),
            Zero,
            /// Divisor at position `row`, compared from `bit` down.
            Compare {
                row: usize,
                bit: usize,
            },
            /// Divisor at position `row`, subtracted from `bit` up; a carry is no borrow.
            Subtract {
                row: usize,
                bit: usize,
                carry: bool,
            },
            Done,
        }
        let width = self.result.len();
        let quotient = subnet.register(Register::Quotient, if self.modulo { 0 } else { self.ty.width });
        // The rest of the dividend is less than twice the divisor: of a constant divisor, few bits are read.
        let known = self.divisor.iter().all(|wire| wire.known().is_some());
        let reach =
            self.divisor.iter().rposition(|wire| known && wire.known() == Some(true)).map_or(width, |top| top + 1);
        let highest = |row: usize| reach.min(width - 1 - row);
        let row = |row: usize| State::Compare { row, bit: highest(row) };
        let below = |at: usize| if at == 0 { State::Done } else { row(at - 1) };
        subnet.walk(from, State::Leading(width - 1), |subnet, state| match *state {
            State::Leading(bit) => {
                let zero = if bit == 0 { State::Zero } else { State::Leading(bit - 1) };
                match self.divisor[bit].known() {
                    Some(true) => Stage::Same(row(width - 1 - bit)),
                    Some(false) => Stage::Same(zero),
                    None => Stage::Branch(
                        self.divisor[bit].branch(|value| if value { row(width - 1 - bit) } else { zero.clone() }),
                    ),
                }
            }
            State::Zero => Stage::Leave(subnet.hazard(Hazard::DivisionByZero)),
            State::Compare { row, bit } => {
                let alternatives = compare::alternatives(self.result[row + bit], &self.divisor[bit], false);
                let after = |ordering: Ordering| match ordering {
                    Ordering::Less => below(row),
                    Ordering::Equal if bit > 0 => State::Compare { row, bit: bit - 1 },
                    _ => State::Subtract { row, bit: 0, carry: true },
                };
                let branches = alternatives.into_iter().map(|(changes, ordering)| (changes, after(ordering)));
                Stage::Branch(branches.collect())
            }
            State::Subtract { row, bit, carry } => {
                let after = |carry: bool| {
                    if bit == highest(row) { below(row) } else { State::Subtract { row, bit: bit + 1, carry } }
                };
                let wire = self.divisor[bit].clone().complement();
                // The first step sets the bit of the quotient.
                let noted = quotient.get(row).filter(|_| bit == 0).map(|&bit| (bit, false, true));
                if noted.is_none() && wire.known() == Some(carry) {
                    return Stage::Same(after(carry));
                }
                let branches = add::alternatives(self.result[row + bit], &wire, carry).into_iter();
                let branches = branches.map(|(mut changes, [_, carry])| {
                    changes.extend(noted);
                    (changes, after(carry))
                });
                Stage::Branch(branches.collect())
            }
            State::Done => Stage::Leave(to),
        });
    }

    /// Sets the result to 0 if the divisor is 0. The divisor's register is 0 then.
    fn after_zero(&self, subnet: &mut Subnet<'_>) {
        let Some(mut at) = subnet.met(Hazard::DivisionByZero) else { return };
        if self.ty.is_signed() {
            let (mark, to) = (subnet.mark(), subnet.within());
            VALUES.iter().for_each(|&old| subnet.step(at, to, &[(mark, old, false)]));
            at = to;
        }
        clear(subnet, at, subnet.next(), &self.result);
    }

    /// Replaces the current result by quotient or remainder, with its sign; the registers become 0.
    fn finish(&self, subnet: &mut Subnet<'_>, from: PlaceId) {
        let next = subnet.next();
        let mut steps: Vec<Step> = Vec::new();
        if !self.modulo {
            for (quotient, &bit) in subnet.register(Register::Quotient, self.ty.width).into_iter().zip(&self.result) {
                let step = VALUES.map(|value| VALUES.map(|old| smallvec![(bit, old, value), (quotient, value, false)]));
                steps.push(step.into_iter().flatten().collect());
            }
        }
        steps.extend(self.register.iter().map(|&bit| Wire::fixed(false).assign(bit)));
        if !self.ty.is_signed() {
            return subnet.chain(from, next, &steps);
        }
        let signs = if steps.is_empty() { from } else { subnet.within() };
        if !steps.is_empty() {
            subnet.chain(from, signs, &steps);
        }
        self.give_sign(subnet, signs);
    }

    /// Gives the result its sign: the remainder has that of the dividend, the quotient is negative if the signs differ.
    /// A positive quotient can be too great by one.
    fn give_sign(&self, subnet: &mut Subnet<'_>, from: PlaceId) {
        let (mark, next) = (subnet.mark(), subnet.next());
        let negative = subnet.within();
        let highest = self.result[self.result.len() - 1];
        let sign = self.given.last().filter(|_| !self.modulo).cloned().unwrap_or(Wire::fixed(false));
        let positive = if self.modulo { next } else { subnet.within() };
        for was_negative in VALUES {
            for (value, given) in &sign.0 {
                let to = if was_negative ^ value { negative } else { positive };
                subnet.step(from, to, &with((mark, was_negative, false), given));
            }
        }
        negate(subnet, negative, next, &self.result);
        if !self.modulo {
            let overflow = subnet.hazard(Hazard::Overflow);
            subnet.step(positive, next, &[(highest, false, false)]);
            subnet.step(positive, overflow, &[(highest, true, true)]);
            subnet.after_hazard(Hazard::Overflow, next);
        }
    }
}
