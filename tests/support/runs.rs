//! Runs by chance.

use petril::explore::ScanState;
use petril::flat::Tolerated;
use petril::simulate::{Chance, scan};
use petril::translate::System;
use petril::witness::ScanTrace;

/// What a PLC usually does goes on; an index outside its array does not.
pub const TOLERATED: Tolerated = Tolerated { overflow: true, division_by_zero: true };

/// So many scans by chance, or fewer if one of them fails; that one is left out.
pub fn by_chance(system: &System, seed: u64, scans: usize) -> ScanTrace {
    let mut chance = Chance::new(system, seed);
    let mut trace = ScanTrace { scans: Vec::new(), loop_start: None };
    let mut state = ScanState::power_on(system);
    for _ in 0..scans {
        let plan = chance.plan(&state);
        let (made, failure) = scan(system, TOLERATED, &state, &plan).unwrap();
        let (None, Some(end)) = (failure, &made.end) else { break };
        state = end.clone();
        trace.scans.push(made);
    }
    trace
}
