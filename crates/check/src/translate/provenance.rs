//! What each node of a system net stands for: the way back from net to source.

use std::fmt;

use petril_lang::flat::Hazard;
use petril_lang::semantics::VarId;

/// The three parts of a system net (seed paper, table 2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// The program.
    User,
    /// The PLC's cycle around it.
    System,
    /// The environment.
    Plant,
}

impl Part {
    /// All parts in the order of the paper's table.
    pub const ALL: [Part; 3] = [Part::User, Part::System, Part::Plant];

    /// The part's name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Part::User => "user",
            Part::System => "system",
            Part::Plant => "plant",
        }
    }
}

/// What a place stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PlaceRole {
    /// The bit of the variable has this value.
    Bit {
        /// The variable.
        variable: VarId,
        /// Position of the bit, from 0, the lowest.
        bit: u32,
        /// The value.
        value: bool,
    },
    /// The bit of the current result has this value.
    Result {
        /// Position of the bit, from 0, the lowest.
        bit: u32,
        /// The value.
        value: bool,
    },
    /// The bit of an auxiliary register has this value. Between two lines all of them are 0.
    Register {
        /// The register.
        register: Register,
        /// Position of the bit, from 0, the lowest.
        bit: u32,
        /// The value.
        value: bool,
    },
    /// Control is before this line (from 0); the line behind the last is `End`.
    Line(usize),
    /// Control is within this line (from 0), at one of its places, counted from 1.
    Within(usize, u32),
    /// Control is within this line (from 0), and the hazard has just happened there.
    Hazard(usize, Hazard),
    /// Control is between two scans.
    Idle,
    /// Control is before the copying of this input.
    Copy(VarId),
    /// Control is within the copying of this input, at one of its places, counted from 1.
    Copying(VarId, u32),
    /// The plant component (counted over all plants) may move.
    Blocking(usize),
    /// A place of the plant component.
    Plant(usize),
}

impl PlaceRole {
    /// The part the place belongs to.
    #[must_use]
    pub fn part(self) -> Part {
        match self {
            Self::Idle | Self::Copy(_) | Self::Copying(..) | Self::Blocking(_) => Part::System,
            Self::Plant(_) => Part::Plant,
            _ => Part::User,
        }
    }

    /// Whether the one token of control can be there.
    #[must_use]
    pub fn is_control(self) -> bool {
        !self.is_bit() && !matches!(self, Self::Blocking(_) | Self::Plant(_))
    }

    /// Whether it is one of the two places of a bit.
    #[must_use]
    pub fn is_bit(self) -> bool {
        matches!(self, Self::Bit { .. } | Self::Result { .. } | Self::Register { .. })
    }
}

/// Bits that multiplication and division need beside the current result. A net has those that its program needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Register {
    /// The right operand, or its magnitude.
    Operand,
    /// The bits of a quotient found so far.
    Quotient,
    /// One bit: a multiplication has overflowed, a dividend was negative.
    Mark,
}

impl fmt::Display for Register {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Operand => "operand",
            Self::Quotient => "quotient",
            Self::Mark => "mark",
        })
    }
}

/// What a transition stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TransitionRole {
    /// Executes the instruction of this line (from 0), or a step of it.
    Line(usize),
    /// Begins a scan: stops the plant.
    Block,
    /// Copies a bit of the external value of this input to the variable.
    Copy {
        /// The input.
        variable: VarId,
        /// Position of the bit, from 0, the lowest.
        bit: u32,
        /// Its new value.
        value: bool,
    },
    /// Ends a scan: lets the plant move.
    Unblock,
    /// A transition of the plant component (counted over all plants): its position there.
    Plant {
        /// The component.
        component: usize,
        /// The transition's position in [`super::plant::Component::transitions`].
        transition: usize,
    },
}

impl TransitionRole {
    /// The part the transition belongs to.
    #[must_use]
    pub fn part(self) -> Part {
        match self {
            Self::Line(_) => Part::User,
            Self::Block | Self::Copy { .. } | Self::Unblock => Part::System,
            Self::Plant { .. } => Part::Plant,
        }
    }
}
