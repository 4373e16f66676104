//! Provenance of the nodes of a system net: what each stands for in the source.

use std::fmt;

use petril_lang::flat::Hazard;
use petril_lang::semantics::VarId;

/// Part of a system net (seed paper, table 2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// User program.
    User,
    /// Cycle of the PLC around the program: the system program.
    System,
    /// Environment.
    Plant,
}

impl Part {
    /// Every part, in the order of the paper's table.
    pub const ALL: [Part; 3] = [Part::User, Part::System, Part::Plant];

    /// Name of the part in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Part::User => "user",
            Part::System => "system",
            Part::Plant => "plant",
        }
    }
}

/// Role of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PlaceRole {
    /// Bit of a variable: marked while the bit has this value.
    Bit {
        /// Variable of the bit.
        variable: VarId,
        /// Position of the bit, from 0, the lowest.
        bit: u32,
        /// Value of the bit.
        value: bool,
    },
    /// Bit of the current result: marked while the bit has this value.
    Result {
        /// Position of the bit, from 0, the lowest.
        bit: u32,
        /// Value of the bit.
        value: bool,
    },
    /// Bit of an auxiliary register: marked while the bit has this value. Between two lines all these bits are 0.
    Register {
        /// Register of the bit.
        register: Register,
        /// Position of the bit, from 0, the lowest.
        bit: u32,
        /// Value of the bit.
        value: bool,
    },
    /// Control place before this line (from 0); the line after the last is `End`.
    Line(usize),
    /// Control place within this line (from 0), by its number in the line, from 1.
    Within(usize, u32),
    /// Control place within this line (from 0) that is reached when the hazard has happened there.
    Hazard(usize, Hazard),
    /// Control place between two scans.
    Idle,
    /// Control place before the copying of this input.
    Copy(VarId),
    /// Control place within the copying of this input, by its number there, from 1.
    Copying(VarId, u32),
    /// Blocking place: marked while the plant component (counted over all plants) may move.
    Blocking(usize),
    /// Place of the plant component (counted over all plants).
    Plant(usize),
}

impl PlaceRole {
    /// Part that the place belongs to.
    #[must_use]
    pub fn part(self) -> Part {
        match self {
            Self::Idle | Self::Copy(_) | Self::Copying(..) | Self::Blocking(_) => Part::System,
            Self::Plant(_) => Part::Plant,
            _ => Part::User,
        }
    }

    /// Whether the place is a control place, one of those that share the single control token.
    #[must_use]
    pub fn is_control(self) -> bool {
        !self.is_bit() && !matches!(self, Self::Blocking(_) | Self::Plant(_))
    }

    /// Whether the place is one of the two of a bit.
    #[must_use]
    pub fn is_bit(self) -> bool {
        matches!(self, Self::Bit { .. } | Self::Result { .. } | Self::Register { .. })
    }
}

/// Auxiliary register of multiplication and division. A net has only those that its program needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Register {
    /// Right operand, or its magnitude.
    Operand,
    /// Bits of a quotient found so far.
    Quotient,
    /// Single bit: a multiplication has overflowed, or a dividend was negative.
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

/// Role of a transition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TransitionRole {
    /// Executes the instruction of this line (from 0), or a step of it.
    Line(usize),
    /// Begins a scan: stops the plant.
    Block,
    /// Copies a bit of the external value of this input to the variable.
    Copy {
        /// Input.
        variable: VarId,
        /// Position of the bit, from 0, the lowest.
        bit: u32,
        /// New value of the bit.
        value: bool,
    },
    /// Ends a scan: lets the plant move.
    Unblock,
    /// Transition of a plant component.
    Plant {
        /// Component, counted over all plants.
        component: usize,
        /// Position of the transition in [`super::plant::Component::transitions`].
        transition: usize,
    },
}

impl TransitionRole {
    /// Part that the transition belongs to.
    #[must_use]
    pub fn part(self) -> Part {
        match self {
            Self::Line(_) => Part::User,
            Self::Block | Self::Copy { .. } | Self::Unblock => Part::System,
            Self::Plant { .. } => Part::Plant,
        }
    }
}
