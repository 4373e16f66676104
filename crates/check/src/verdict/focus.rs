//! The parts of a run that matter to its requirement: variables and scans to show.

use std::collections::BTreeSet;

use super::{Answer, Outcome, Trace, Witness};
use crate::translate::System;
use crate::witness::{Columns, Piece, fold};
use petril_lang::semantics::VarId;

/// The parts of a run that matter to its requirement; reports may hide the others.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Focus {
    /// Variables that the requirement mentions, or on which the violation depends.
    pub variables: BTreeSet<VarId>,
    /// Scans (from 0) to show: of the violation, of a last write, of an input that matters.
    pub scans: BTreeSet<usize>,
}

impl Focus {
    /// Collects what matters in a run of an answer.
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

    /// Default columns of a table of the run.
    #[must_use]
    pub fn columns(&self, system: &System) -> Columns {
        Columns::declared(&system.program, &self.variables)
    }

    /// Splits a run into shown scans and folded stretches, for the given columns; empty for a run of firings.
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
