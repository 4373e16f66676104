//! Diagnosis of a run-time error: expected and actual value at the instruction, and the writers of its operands.

use super::super::{Trace, Why, Witness, Writer};
use crate::translate::System;
use crate::witness::failed;

/// Diagnoses the last scan of a replayed run that ends in an error or never ends; `None` for other runs.
pub fn of_error(system: &System, witness: &Witness) -> Option<Why> {
    let Trace::Scans(trace) = &witness.trace else { return None };
    let failed = failed(system, trace)?;
    let writers = failed.writes.iter().map(|&(variable, write)| Writer {
        variable,
        value: write.value,
        scan: write.scan,
        line: write.line,
    });
    Some(Why {
        wanted: vec![failed.wanted.clone()],
        writers: writers.collect(),
        unwritten: failed.unwritten,
        repair: None,
        unrepaired: None,
    })
}
