//! Inputs that a program only compares with constants.

use std::collections::BTreeSet;

use super::{FlatProgram, Function, Instruction, Operand, Target};
use crate::semantics::{Type, VarId};

/// Cut points of a number's range: `c` is one if the program may distinguish `c` and `c + 1`.
pub type Cuts = BTreeSet<i128>;

impl FlatProgram {
    /// Cut points of an input that the program only compares with constants: it loads the input and compares it in the
    /// next line, or compares a constant with it. `None` if it does anything else with the input, like storing it or
    /// computing with it.
    #[must_use]
    pub fn compared(&self, input: VarId) -> Option<Cuts> {
        let ty = self.variable(input).ty;
        let mut cuts = Cuts::new();
        for (line, code) in self.code.iter().enumerate() {
            let chosen_by = |target| matches!(target, Target::Element(element) if element.index == input);
            if code.instruction.writes().is_some_and(chosen_by) {
                return None;
            }
            let Some(place) = code.instruction.reads() else { continue };
            match place {
                Target::Variable(variable) if variable != input => continue,
                Target::Element(element) if element.index != input && element.all().all(|id| id != input) => continue,
                Target::Element(_) => return None,
                Target::Variable(_) => {}
            }
            cuts.extend(match code.instruction {
                Instruction::Load { ty: loaded, negated: false, .. } if loaded == ty => self.next_compares(line, ty)?,
                Instruction::Combine { function, ty: taken, negated: false, .. } if taken == ty => {
                    let constant = self.constant_before(line, ty)?;
                    self::cuts(mirrored(function)?, constant)
                }
                _ => return None,
            });
        }
        Some(cuts)
    }

    /// Cut points of the line after a load, which is executed right after it.
    fn next_compares(&self, line: usize, ty: Type) -> Option<Cuts> {
        match self.code.get(line + 1).map(|code| code.instruction) {
            // The loaded value is never used.
            None | Some(Instruction::Load { .. }) => Some(Cuts::new()),
            Some(Instruction::Combine { function, ty: taken, negated: false, operand: Operand::Constant(pattern) })
                if taken == ty && function.compares() =>
            {
                Some(cuts(function, ty.number(pattern)))
            }
            _ => None,
        }
    }

    /// Constant that is always the current result before a line, if there is one.
    fn constant_before(&self, line: usize, ty: Type) -> Option<i128> {
        let is_target =
            |code: &super::Line| matches!(code.instruction, Instruction::Jump { target, .. } if target == line);
        if self.code.iter().any(is_target) {
            return None;
        }
        match self.code[line.checked_sub(1)?].instruction {
            Instruction::Load { ty: loaded, negated: false, operand: Operand::Constant(pattern) } if loaded == ty => {
                Some(ty.number(pattern))
            }
            _ => None,
        }
    }
}

/// Cut points of a comparison with a constant on its right.
fn cuts(function: Function, constant: i128) -> Cuts {
    match function {
        Function::Gt | Function::Le => Cuts::from([constant]),
        Function::Ge | Function::Lt => Cuts::from([constant - 1]),
        _ => Cuts::from([constant - 1, constant]),
    }
}

/// Comparison with its sides exchanged; `None` for other functions.
fn mirrored(function: Function) -> Option<Function> {
    Some(match function {
        Function::Gt => Function::Lt,
        Function::Ge => Function::Le,
        Function::Le => Function::Ge,
        Function::Lt => Function::Gt,
        Function::Eq | Function::Ne => function,
        _ => return None,
    })
}
