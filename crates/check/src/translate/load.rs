//! `LD x`, `LDN x`: the current result takes the operand's value, complemented for `LDN`.

use super::subnet::{Step, Subnet};
use petril_lang::flat::Operand;
use petril_lang::semantics::Type;

pub fn translate(subnet: &mut Subnet<'_>, ty: Type, negated: bool, operand: Operand) {
    let wires = subnet.wires(ty, negated, operand);
    let steps: Vec<Step> =
        wires.iter().zip(subnet.result(ty.width)).map(|(wire, result)| wire.assign(result)).collect();
    subnet.chain(subnet.here(), subnet.next(), &steps);
}
