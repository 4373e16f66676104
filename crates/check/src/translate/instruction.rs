//! Subnet of an instruction (*Compute* in the seed paper, section 3.3).

use super::subnet::Subnet;
use super::{add, bound, combine, compare, complement, convert, divide, jump, load, multiply, set_reset, shift, store};
use petril_lang::flat::{Function, Instruction, Operand};
use petril_lang::semantics::Type;

pub fn translate(subnet: &mut Subnet<'_>, instruction: Instruction) {
    match instruction {
        Instruction::Load { ty, negated, operand } => load::translate(subnet, ty, negated, operand),
        Instruction::Store { ty, negated, target } => store::translate(subnet, ty, negated, target),
        Instruction::Set(target) => set_reset::translate(subnet, target, true),
        Instruction::Reset(target) => set_reset::translate(subnet, target, false),
        Instruction::Complement(ty) => complement::translate(subnet, ty),
        Instruction::Combine { function, ty, negated, operand } => function_of(subnet, function, ty, negated, operand),
        Instruction::Convert { from, to } => convert::translate(subnet, from, to),
        Instruction::Bound { ty, lower, upper, hazard } => bound::translate(subnet, ty, (lower, upper), hazard),
        Instruction::Jump { condition, target } => jump::translate(subnet, condition, target),
    }
}

fn function_of(subnet: &mut Subnet<'_>, function: Function, ty: Type, negated: bool, operand: Operand) {
    let wires = subnet.wires(ty, negated, operand);
    match function {
        Function::And | Function::Or | Function::Xor => combine::translate(subnet, function, ty, &wires),
        Function::Add | Function::Sub => add::translate(subnet, ty, function == Function::Sub, wires),
        Function::Mul => multiply::translate(subnet, ty, negated, operand),
        Function::Div | Function::Mod => divide::translate(subnet, ty, function == Function::Mod, negated, operand),
        Function::Shl | Function::Shr | Function::Rol | Function::Ror => {
            shift::translate(subnet, function, ty, negated, operand);
        }
        _ => compare::translate(subnet, function, ty, &wires),
    }
}

/// Number of bits of the current result that an instruction works on.
pub fn width(instruction: &Instruction) -> u32 {
    match *instruction {
        Instruction::Load { ty, .. }
        | Instruction::Store { ty, .. }
        | Instruction::Complement(ty)
        | Instruction::Combine { ty, .. }
        | Instruction::Bound { ty, .. } => ty.width,
        Instruction::Convert { from, to } => from.width.max(to.width),
        Instruction::Set(_) | Instruction::Reset(_) | Instruction::Jump { .. } => 1,
    }
}
