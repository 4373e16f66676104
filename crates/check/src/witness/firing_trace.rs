//! Traces of the transition view: firing sequences.

use serde::{Deserialize, Serialize};

use super::replay::{Disagreement, Replay};
use crate::translate::System;
use petril_net::Markings;
use petril_net::net::TransitionId;
use petril_search::Step;

/// Firing sequence from the initial marking.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FiringTrace {
    /// Transitions in the order of firing.
    pub firings: Vec<TransitionId>,
    /// For a lasso, the number of firings before the marking that the last firing returns to.
    pub loop_start: Option<usize>,
}

/// Reconstructs the firings between consecutive packed markings, the first being the initial one.
#[must_use]
pub fn firing_trace(markings: &Markings<'_>, states: &[&[u64]], loop_start: Option<usize>) -> FiringTrace {
    let closing = loop_start.map(|start| states[start]);
    let successors = states.iter().skip(1).copied().chain(closing);
    let firings = states.iter().zip(successors).filter_map(|(&from, to)| {
        let mut fired = None;
        markings.firings(from, &mut |transition, step| {
            if fired.is_none() && matches!(step, Step::To(next) if next == to) {
                fired = Some(transition);
            }
        });
        fired
    });
    FiringTrace { firings: firings.collect(), loop_start }
}

/// Replays a trace and calls `at` with the number of firings so far, beginning with 0.
///
/// # Errors
/// The trace is not one of the system, or `at` finds that it does not show the expected facts.
pub fn replay_firings(
    system: &System,
    trace: &FiringTrace,
    mut at: impl FnMut(usize, &Replay<'_>) -> Result<(), Disagreement>,
) -> Result<(), Disagreement> {
    let mut replay = Replay::new(system);
    let mut knot = None;
    for position in 0..=trace.firings.len() {
        if trace.loop_start == Some(position) {
            knot = Some(replay.marking().clone());
        }
        at(position, &replay)?;
        if let Some(&transition) = trace.firings.get(position) {
            replay.fire(transition)?;
        }
    }
    match knot {
        Some(knot) if knot != *replay.marking() => Err(Disagreement("the lasso does not close".to_owned())),
        _ => Ok(()),
    }
}
