//! Failing scans: a run to one of them, and the reason why unexplored steps leave a verdict open.

use super::{Note, Trace, Witness};
use crate::scans::{Failure, ScanSpace};
use crate::witness::{Disagreement, replay_scans, scan_trace};
use petril_lang::flat::Hazard;
use petril_lang::interpret::Fault;
use petril_search::{Graph, Stop};

/// Result of a search for scans that fail in some way.
pub enum Failing {
    /// No explored scan fails so.
    None,
    /// Shortest run to such a scan, replayed.
    Shown(Witness),
    /// Replay and search disagree.
    Refuted(Disagreement),
}

/// Finds the shortest run whose last scan fails in this way.
pub fn failing_scan(space: &ScanSpace<'_>, graph: &Graph, kind: impl Fn(&Failure) -> bool) -> Failing {
    let mut failures = graph.failures().iter().filter_map(|&(state, dead_end)| Some((state, Failure::of(dead_end)?)));
    let Some((state, failure)) = failures.find(|(_, failure)| kind(failure)) else {
        return Failing::None;
    };
    let path = state.map(|state| graph.path_to(state)).unwrap_or_default();
    let states: Vec<&[u64]> = path.iter().map(|&state| graph.state(state)).collect();
    let trace = scan_trace(space, &states, None, Some(failure));
    let system = space.system();
    match replay_scans(system, &trace, |_, _| Ok(())) {
        Ok(()) => {
            let last = trace.scans.len().saturating_sub(1);
            let text = match failure {
                Failure::Hazard(line, hazard) => {
                    let code = &system.program.code[line];
                    let instruction = system.program.text(code.instruction);
                    let words = instruction.split_whitespace().collect::<Vec<_>>().join(" ");
                    format!("{} in line {} of the flat code (`{words}`)", event(hazard), line + 1)
                }
                _ => "this scan never ends: it repeats a state".to_owned(),
            };
            Failing::Shown(Witness { trace: Trace::Scans(trace), notes: vec![Note { first: last, last, text }] })
        }
        Err(disagreement) => Failing::Refuted(disagreement),
    }
}

/// Description of a hazard as an event.
fn event(hazard: Hazard) -> &'static str {
    match hazard {
        Hazard::Overflow => "a number did not fit its type",
        Hazard::DivisionByZero => "a number was divided by 0",
        Hazard::Index => "an index was outside its array",
        Hazard::Subrange => "a value was outside the subrange of its variable",
    }
}

/// Reason for an incomplete answer: the search was ended, or scans have no end state.
pub fn what_is_missing(graph: &Graph) -> String {
    match graph.failures().first().map(|&(_, dead_end)| Failure::of(dead_end)) {
        None if graph.is_complete() && graph.is_empty() => {
            "the assumptions allow no inputs for the first scan, so nothing was explored".to_owned()
        }
        _ if *graph.stop() != Stop::Complete => {
            format!("{}; the {} states explored do not decide it", graph.stop(), graph.len())
        }
        Some(Some(Failure::Hazard(_, hazard))) => {
            let option = match hazard {
                Hazard::Overflow => " (`--overflow wrap` goes on with what fits)",
                Hazard::DivisionByZero => " (`--div0 zero` goes on with 0)",
                Hazard::Index | Hazard::Subrange => "",
            };
            format!("the check `{hazard}` is violated, and what comes after such an error is not known{option}")
        }
        Some(Some(Failure::Scan(Fault::Endless | Fault::TooLong))) => {
            "a scan does not end, so that not every step leads to a state (see the check `scan-ends`)".to_owned()
        }
        _ => format!("{}; the {} states explored do not decide it", graph.stop(), graph.len()),
    }
}
