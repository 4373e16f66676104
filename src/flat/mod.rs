//! Flat code: the seed paper's *Env* and *Code* (Heiner and Menzel, section 2.2).
//!
//! One strictly sequential list of instructions on single bits: parentheses are buffered in fresh variables, labels are
//! line numbers, a return is a jump to the end. Both the interpreter and the net are made from it.

mod carried;
mod lower;
mod print;

pub use lower::flatten;

use crate::semantics::{Condition, Function, Operand, Role, VarId, Variable};
use crate::source::Span;

/// A flat program.
///
/// Lines are counted from 0 in the code and from 1 wherever people read them; line `code.len()` is the end.
#[derive(Clone, Debug)]
pub struct FlatProgram {
    /// Name of the program.
    pub name: String,
    /// The declared variables in their order, then the buffers.
    pub variables: Vec<Variable>,
    /// The instructions in their order.
    pub code: Vec<Line>,
}

/// One line of flat code.
#[derive(Clone, Debug)]
pub struct Line {
    /// What it does.
    pub instruction: Instruction,
    /// The piece of source it comes from.
    pub span: Span,
}

/// An instruction of flat code. CR is the current result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instruction {
    /// CR := operand, complemented if `negated`.
    Load {
        /// Modifier N.
        negated: bool,
        /// What is loaded.
        operand: Operand,
    },
    /// variable := CR, complemented if `negated`.
    Store {
        /// Modifier N.
        negated: bool,
        /// Where to.
        variable: VarId,
    },
    /// variable := TRUE if CR is TRUE.
    Set(VarId),
    /// variable := FALSE if CR is TRUE.
    Reset(VarId),
    /// CR := NOT CR.
    Complement,
    /// CR := CR function operand, the operand complemented if `negated`.
    Combine {
        /// The function.
        function: Function,
        /// Modifier N.
        negated: bool,
        /// The right operand.
        operand: Operand,
    },
    /// Go on at the line `target` if the condition holds of CR.
    Jump {
        /// When.
        condition: Condition,
        /// Line, counted from 0.
        target: usize,
    },
}

impl FlatProgram {
    /// The line behind the last one, where every scan ends.
    #[must_use]
    pub fn end(&self) -> usize {
        self.code.len()
    }

    /// A variable.
    #[must_use]
    pub fn variable(&self, id: VarId) -> &Variable {
        &self.variables[id.0]
    }

    /// The variables of a role, in the order of declaration.
    pub fn with_role(&self, role: Role) -> impl Iterator<Item = VarId> + Clone {
        (0..self.variables.len()).map(VarId).filter(move |&id| self.variable(id).role == role)
    }

    /// The variables the user declared; the valuation of these is a scan state.
    pub fn declared(&self) -> impl Iterator<Item = VarId> + Clone {
        (0..self.variables.len()).map(VarId).filter(|&id| self.variable(id).role != Role::Buffer)
    }

    /// The variable of a name, however it is spelt. Buffers have no name that could be asked for.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<VarId> {
        self.declared().find(|&id| self.variable(id).name.eq_ignore_ascii_case(name))
    }
}
