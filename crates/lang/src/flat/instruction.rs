//! Typed instructions of flat code: each says how wide the current result (CR) is.

use std::fmt;

pub use crate::semantics::{Condition, Function};
use serde::{Deserialize, Serialize};

use crate::semantics::{Type, VarId};

/// Instruction of flat code: its effect on the memory and the current result (CR).
///
/// CR is a pattern of as many bits as the instruction's type has; higher bits are never read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instruction {
    /// `LD`, `LDN`: CR := operand, every bit complemented if `negated`.
    Load {
        /// Type of operand and CR.
        ty: Type,
        /// Whether modifier N is set.
        negated: bool,
        /// Operand loaded.
        operand: Operand,
    },
    /// `ST`, `STN`: target := CR, every bit complemented if `negated`.
    Store {
        /// Type of target and CR.
        ty: Type,
        /// Whether modifier N is set.
        negated: bool,
        /// Variable or element written.
        target: Target,
    },
    /// `S`: target := TRUE if CR is TRUE; target and CR are `BOOL`.
    Set(Target),
    /// `R`: target := FALSE if CR is TRUE; target and CR are `BOOL`.
    Reset(Target),
    /// `NOT`: every bit of CR is complemented.
    Complement(Type),
    /// CR := CR function operand, the operand complemented if `negated`. A comparison gives a `BOOL`.
    Combine {
        /// Function applied.
        function: Function,
        /// Type of CR and operand. A shift's operand may be of any type: its pattern is an unsigned number.
        ty: Type,
        /// Whether modifier N is set.
        negated: bool,
        /// Right operand.
        operand: Operand,
    },
    /// CR := the same number in another type, modulo 2^width; to `BOOL`: whether it is not 0. A number outside the new
    /// type is an overflow, if the type is one of numbers.
    Convert {
        /// Type before.
        from: Type,
        /// Type after.
        to: Type,
    },
    /// Range check: a number outside `lower ..= upper` is a hazard. CR keeps its value, but [`Hazard::Index`] makes it
    /// `lower`.
    Bound {
        /// Type of CR.
        ty: Type,
        /// Least number allowed.
        lower: i128,
        /// Greatest number allowed.
        upper: i128,
        /// Hazard that a number outside the range is.
        hazard: Hazard,
    },
    /// Jump to `target` if the condition holds of CR, a `BOOL`.
    Jump {
        /// Condition of the jump.
        condition: Condition,
        /// Line jumped to, from 0; the length of the code stands for the end.
        target: usize,
    },
}

/// Operand of an instruction: a variable, an element of an array, or a literal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// Variable or element.
    Place(Target),
    /// Literal, as a pattern of the instruction's type.
    Constant(u64),
}

/// Memory that an instruction reads or writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Variable.
    Variable(VarId),
    /// Element of an array, selected by the value of a variable.
    Element(Element),
}

/// Element of an array: one of the `length` variables `first`, `first + stride`, …, which are all of one type. The
/// value of `index`, a buffer, selects it and is always less than `length`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Element {
    /// Variable at index 0.
    pub first: VarId,
    /// Distance from one variable to the next.
    pub stride: usize,
    /// Number of variables.
    pub length: usize,
    /// Variable that holds the index.
    pub index: VarId,
}

impl Element {
    /// Variable at an index.
    #[must_use]
    pub fn at(&self, index: usize) -> VarId {
        VarId(self.first.0 + index * self.stride)
    }

    /// Iterator over the variables that the element can be.
    pub fn all(self) -> impl Iterator<Item = VarId> {
        (0..self.length).map(move |index| self.at(index))
    }
}

/// Run-time error that an instruction can meet, checked in every program without a requirement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Hazard {
    /// A number is outside its type. The result is taken modulo 2^width.
    Overflow,
    /// A divisor is 0. The result is 0.
    DivisionByZero,
    /// An index is outside its array. The least index is used instead.
    Index,
    /// A value is outside the subrange of its variable. The value is stored all the same.
    Subrange,
}

impl Hazard {
    /// Every hazard.
    pub const ALL: [Self; 4] = [Self::Overflow, Self::DivisionByZero, Self::Index, Self::Subrange];

    /// Name of the check that looks for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Overflow => "overflow",
            Self::DivisionByZero => "division-by-zero",
            Self::Index => "index",
            Self::Subrange => "subrange",
        }
    }
}

impl fmt::Display for Hazard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Instruction {
    /// Variable or element that the instruction reads, besides CR.
    #[must_use]
    pub fn reads(&self) -> Option<Target> {
        match *self {
            Self::Load { operand: Operand::Place(place), .. }
            | Self::Combine { operand: Operand::Place(place), .. } => Some(place),
            _ => None,
        }
    }

    /// Variable or element that the instruction writes, besides CR. Set and reset may leave it unchanged.
    #[must_use]
    pub fn writes(&self) -> Option<Target> {
        match *self {
            Self::Store { target, .. } | Self::Set(target) | Self::Reset(target) => Some(target),
            _ => None,
        }
    }

    /// Type of CR after the instruction; `None` if CR does not change.
    #[must_use]
    pub fn gives(&self) -> Option<Type> {
        match *self {
            Self::Combine { function, .. } if function.compares() => Some(Type::BOOL),
            Self::Load { ty, .. } | Self::Complement(ty) | Self::Combine { ty, .. } | Self::Convert { to: ty, .. } => {
                Some(ty)
            }
            _ => None,
        }
    }

    /// Hazards that the instruction can meet.
    #[must_use]
    pub fn hazards(&self) -> &'static [Hazard] {
        match *self {
            Self::Combine { function, ty, .. } => match function {
                Function::Add | Function::Sub | Function::Mul if ty.kind != crate::semantics::Kind::Bits => {
                    &[Hazard::Overflow]
                }
                Function::Div if ty.is_signed() => &[Hazard::Overflow, Hazard::DivisionByZero],
                Function::Div | Function::Mod => &[Hazard::DivisionByZero],
                _ => &[],
            },
            Self::Convert { from, to } if to.overflows_from(from) => &[Hazard::Overflow],
            Self::Bound { hazard: Hazard::Index, .. } => &[Hazard::Index],
            Self::Bound { .. } => &[Hazard::Subrange],
            _ => &[],
        }
    }
}
