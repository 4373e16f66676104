//! The instructions of flat code, typed: each says how wide the current result (CR) is when it works on it.

use std::fmt;

pub use crate::semantics::{Condition, Function};
use serde::{Deserialize, Serialize};

use crate::semantics::{Type, VarId};

/// What an instruction does to the memory and the current result (CR).
///
/// CR is a pattern of as many bits as the instruction's type has; what is in the bits above is never looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instruction {
    /// `LD`, `LDN`: CR := operand, every bit complemented if `negated`.
    Load {
        /// The type of operand and CR.
        ty: Type,
        /// Modifier N.
        negated: bool,
        /// What is loaded.
        operand: Operand,
    },
    /// `ST`, `STN`: target := CR, every bit complemented if `negated`.
    Store {
        /// The type of target and CR.
        ty: Type,
        /// Modifier N.
        negated: bool,
        /// Where to.
        target: Target,
    },
    /// `S`: target := TRUE if CR is TRUE. Both are `BOOL`.
    Set(Target),
    /// `R`: target := FALSE if CR is TRUE. Both are `BOOL`.
    Reset(Target),
    /// `NOT`: every bit of CR is complemented.
    Complement(Type),
    /// CR := CR function operand, the operand complemented if `negated`. A comparison gives a `BOOL`.
    Combine {
        /// The function.
        function: Function,
        /// The type of CR and operand. A shift's operand may be of any type: its pattern is an unsigned number.
        ty: Type,
        /// Modifier N.
        negated: bool,
        /// The right operand.
        operand: Operand,
    },
    /// CR := the same number in another type, modulo 2^width; to `BOOL`: whether it is not 0. A number that is not one of
    /// the new type, of a kind that has numbers, is an overflow.
    Convert {
        /// The type before.
        from: Type,
        /// The type after.
        to: Type,
    },
    /// A number outside `lower ..= upper` is a hazard. CR keeps its value, but [`Hazard::Index`] makes it `lower`.
    Bound {
        /// The type of CR.
        ty: Type,
        /// The least number allowed.
        lower: i128,
        /// The greatest number allowed.
        upper: i128,
        /// What a number outside is.
        hazard: Hazard,
    },
    /// Go on at `target` if the condition holds of CR, a `BOOL`.
    Jump {
        /// When.
        condition: Condition,
        /// A line, from 0; the length of the code stands for the end.
        target: usize,
    },
}

/// Where an instruction takes its operand from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// What an instruction could also write.
    Place(Target),
    /// A literal, as a pattern of the instruction's type.
    Constant(u64),
}

/// What an instruction reads or writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// A variable.
    Variable(VarId),
    /// An element of an array, chosen by the value of a variable.
    Element(Element),
}

/// The variables `first`, `first + stride`, …: as many as `length`, all of one type. The value of `index`, a buffer, says
/// which of them; it is always less than `length`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Element {
    /// The variable at index 0.
    pub first: VarId,
    /// From one to the next.
    pub stride: usize,
    /// How many there are.
    pub length: usize,
    /// The variable that says which.
    pub index: VarId,
}

impl Element {
    /// The variable at an index.
    #[must_use]
    pub fn at(&self, index: usize) -> VarId {
        VarId(self.first.0 + index * self.stride)
    }

    /// The variables it can be.
    pub fn all(self) -> impl Iterator<Item = VarId> {
        (0..self.length).map(move |index| self.at(index))
    }
}

/// What should not happen while a program runs, and is checked without asking.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Hazard {
    /// A number is not one of its type. It goes on modulo 2^width.
    Overflow,
    /// A divisor is 0. The result is 0.
    DivisionByZero,
    /// An index is outside its array. It goes on with the least one.
    Index,
    /// A value is outside the subrange of its variable. It is stored all the same.
    Subrange,
}

impl Hazard {
    /// All of them.
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
    /// What it reads, besides CR.
    #[must_use]
    pub fn reads(&self) -> Option<Target> {
        match *self {
            Self::Load { operand: Operand::Place(place), .. }
            | Self::Combine { operand: Operand::Place(place), .. } => Some(place),
            _ => None,
        }
    }

    /// What it writes, besides CR. Setting and resetting may leave it as it was.
    #[must_use]
    pub fn writes(&self) -> Option<Target> {
        match *self {
            Self::Store { target, .. } | Self::Set(target) | Self::Reset(target) => Some(target),
            _ => None,
        }
    }

    /// The type it gives CR; `None` if CR stays as it is.
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

    /// The hazards it can meet.
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
