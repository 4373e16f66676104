//! Scans of a simulation, in sequence.

use petril::explore::{Failure, ScanState};
use petril::flat::Tolerated;
use petril::logic::Bound;
use petril::simulate::{Watch, scan};
use petril::translate::System;
use petril::witness::ScanTrace;

use super::steering::Steering;

/// Simulated run with its end.
pub struct Run {
    pub trace: ScanTrace,
    /// Failure in the last scan.
    pub failure: Option<Failure>,
    /// Whether the condition is met after the last scan.
    pub is_met: bool,
}

/// Simulates `count` scans, or fewer if the condition is met or a scan fails.
///
/// # Errors
/// The run differs from the recorded one, or a move of the plant is impossible.
pub fn scans(
    system: &System,
    tolerated: Tolerated,
    steering: &mut Steering<'_>,
    count: usize,
    until: Option<&Bound>,
) -> Result<Run, String> {
    let mut run = Run { trace: ScanTrace { scans: Vec::new(), loop_start: None }, failure: None, is_met: false };
    let power_on = ScanState::power_on(system);
    let mut watch = until.map(|condition| Watch::new(condition, &power_on.memory));
    for position in 0..count {
        let from = run.trace.scans.last().and_then(|scan| scan.end.as_ref()).unwrap_or(&power_on);
        let plan = steering.plan(position, from);
        let (scan, failure) = scan(system, tolerated, from, &plan)
            .map_err(|impossible| format!("before scan {}, {impossible}", position + 1))?;
        let recorded = steering.recorded();
        if let Some(difference) = recorded.and_then(|run| run.difference(&system.program, position, &scan)) {
            return Err(difference);
        }
        // The state after a failed scan is undefined.
        let end = scan.end.as_ref().filter(|_| failure.is_none());
        run.is_met = watch.as_mut().zip(end).is_some_and(|(watch, end)| watch.see(&end.memory));
        run.trace.scans.push(scan);
        run.failure = failure;
        if run.is_met || run.failure.is_some() {
            break;
        }
    }
    Ok(run)
}
