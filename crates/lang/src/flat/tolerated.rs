//! Hazards that are tolerated as the defined behaviour of the PLC.

use std::collections::BTreeSet;

use super::{FlatProgram, Hazard};

/// Hazards that count as part of a program's meaning, because the PLC is known to handle them so. All others are
/// errors: after them, nothing is known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tolerated {
    /// Whether numbers that do not fit their type go on modulo 2^width.
    pub overflow: bool,
    /// Whether a division by zero gives 0.
    pub division_by_zero: bool,
}

impl Tolerated {
    /// Whether a hazard is tolerated.
    #[must_use]
    pub fn allows(self, hazard: Hazard) -> bool {
        match hazard {
            Hazard::Overflow => self.overflow,
            Hazard::DivisionByZero => self.division_by_zero,
            Hazard::Index | Hazard::Subrange => false,
        }
    }

    /// First hazard, with its line, that is not tolerated.
    #[must_use]
    pub fn first_error(self, hazards: &[(usize, Hazard)]) -> Option<(usize, Hazard)> {
        hazards.iter().copied().find(|&(_, hazard)| !self.allows(hazard))
    }
}

impl FlatProgram {
    /// Hazards that the program's instructions can meet.
    #[must_use]
    pub fn hazards(&self) -> BTreeSet<Hazard> {
        self.code.iter().flat_map(|line| line.instruction.hazards()).copied().collect()
    }
}
