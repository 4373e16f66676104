//! `AND x`, `OR x`, `XOR x` and their N forms, bit by bit: one transition for each pair of values of current result and
//! operand.

use super::subnet::{Step, Subnet};
use super::weaver::VALUES;
use super::wire::{Wire, with};
use petril_lang::flat::Function;
use petril_lang::semantics::Type;

/// Truth table of the function: its value for (current result, operand) = 00, 01, 10, 11.
fn table(function: Function) -> [bool; 4] {
    match function {
        Function::Or => [false, true, true, true],
        Function::Xor => [false, true, true, false],
        _ => [false, false, false, true],
    }
}

/// Translates a bitwise function. Bits of a wider type that a constant operand does not change take no step.
pub fn translate(subnet: &mut Subnet<'_>, function: Function, ty: Type, wires: &[Wire]) {
    let table = table(function);
    let value = |old: bool, value: bool| table[2 * usize::from(old) + usize::from(value)];
    let changes =
        |wire: &Wire| ty.is_bool() || wire.known().is_none_or(|v| VALUES.iter().any(|&old| value(old, v) != old));
    let mut steps: Vec<Step> = Vec::new();
    for (result, wire) in subnet.result(ty.width).into_iter().zip(wires).filter(|(_, wire)| changes(wire)) {
        let mut step = Step::new();
        for old in VALUES {
            for (read, given) in &wire.0 {
                step.push(with((result, old, value(old, *read)), given));
            }
        }
        steps.push(step);
    }
    subnet.chain(subnet.here(), subnet.next(), &steps);
}
