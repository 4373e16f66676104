//! The parts of a run that matter to its requirement.

use std::collections::BTreeSet;

use super::{Answer, Outcome, Trace, Witness};
use crate::translate::System;
use crate::witness::{Columns, Piece, fold};
use petril_lang::semantics::VarId;

/// The parts of a run that matter to its requirement, so that a form of the report may leave out others.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Focus {
    /// Variables that the requirement speaks of, or on which the break rests.
    pub variables: BTreeSet<VarId>,
    /// Scans (from 0) of which something is said: where the requirement is broken, where a value was written, where an input matters.
    pub scans: BTreeSet<usize>,
}

impl Focus {
    /// What matters in a run that goes with an answer.
    #[must_use]
    pub fn of(answer: &Answer, witness: &Witness) -> Self {
        let mut variables: BTreeSet<VarId> = answer.variables.iter().copied().collect();
        let mut scans: BTreeSet<usize> = witness.notes.iter().flat_map(|note| [note.first, note.last]).collect();
        if let Outcome::Violated(_, Some(why)) = &answer.outcome {
            variables.extend(why.writers.iter().map(|writer| writer.variable).chain(why.unwritten.iter().copied()));
            scans.extend(why.writers.iter().map(|writer| writer.scan));
            let changes = why.repair.iter().flat_map(|repair| &repair.changes);
            changes.for_each(|change| {
                variables.insert(change.input);
                scans.insert(change.scan);
            });
        }
        Self { variables, scans }
    }

    /// The columns of a table of the run, if nothing else is asked for.
    #[must_use]
    pub fn columns(&self, system: &System) -> Columns {
        Columns::declared(&system.program, &self.variables)
    }

    /// The pieces of a run of which these columns are shown; none of a run of firings.
    #[must_use]
    pub fn pieces(&self, system: &System, trace: &Trace, columns: &Columns) -> Vec<Piece> {
        match trace {
            Trace::Scans(trace) => {
                let shown: Vec<VarId> = columns.iter().collect();
                fold(&system.program, trace, &shown, &self.scans)
            }
            Trace::Firings(_) => Vec::new(),
        }
    }
}
