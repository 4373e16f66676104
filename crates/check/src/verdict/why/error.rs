//! Why a run meets an error: what the instruction had to give, what it got, and who wrote the values that led there.

use super::super::{Trace, Why, Witness, Writer};
use crate::translate::System;
use crate::witness::failed;

/// Why the last scan of a run that has been replayed meets an error, or never ends; nothing of other runs.
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
