//! What each node of a system net stands for: the way back from net to source.

use crate::semantics::VarId;

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
    /// The variable has this value.
    Bit {
        /// The variable.
        variable: VarId,
        /// The value.
        value: bool,
    },
    /// The current result has this value.
    Result(bool),
    /// Control is before this line (from 0); the line behind the last is `End`.
    Line(usize),
    /// Control is between two scans.
    Idle,
    /// Control is before the copying of this input.
    Copy(VarId),
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
            Self::Bit { .. } | Self::Result(_) | Self::Line(_) => Part::User,
            Self::Idle | Self::Copy(_) | Self::Blocking(_) => Part::System,
            Self::Plant(_) => Part::Plant,
        }
    }
}

/// What a transition stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TransitionRole {
    /// Executes the instruction of this line (from 0).
    Line(usize),
    /// Begins a scan: stops the plant.
    Block,
    /// Copies the external value of this input to the variable.
    Copy {
        /// The input.
        variable: VarId,
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
