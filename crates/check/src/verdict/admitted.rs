//! Sanity check of the assumptions, made whenever there are any: some inputs satisfy them in every scan. Contradictory
//! assumptions would prove everything.

use super::failing::what_is_missing;
use super::views::{ScanView, SystemView};
use super::{Answer, Note, Outcome, Witness};
use petril_search::{Graph, Stop};

/// Builds the answer of the check from its outcome.
pub fn answer(outcome: Outcome) -> Answer {
    let sentence = "Whatever has happened, the assumptions allow some inputs for the next scan.";
    Answer::of_check("assumptions", sentence, "AG EX TRUE", outcome)
}

/// Searches the state graph for a state from which the assumptions allow no scan.
pub fn outcome(view: &ScanView<'_>) -> Outcome {
    let graph = &view.graph;
    if graph.initial().is_empty() && graph.failures().is_empty() && *graph.stop() == Stop::Complete {
        return Outcome::Unknown(what_is_missing(graph));
    }
    match dead_end(graph) {
        Some(state) => shown(view, state),
        None if graph.is_complete() => Outcome::holds(),
        None if *graph.stop() == Stop::Complete => Outcome::Unknown(what_is_missing(graph)),
        None => Outcome::Unknown(format!("{}; the states explored are no dead ends", graph.stop())),
    }
}

/// The nearest dead end: a state without successors whose steps are all known.
fn dead_end(graph: &Graph) -> Option<u32> {
    let open = graph.open();
    graph.ids().find(|&state| graph.successors(state).is_empty() && !open.contains(state as usize))
}

fn shown(view: &ScanView<'_>, state: u32) -> Outcome {
    let path = view.graph.path_to(state);
    let states: Vec<&[u64]> = path.iter().map(|&state| view.graph.state(state)).collect();
    let last = states.len() - 1;
    match view.replayed(&states, None, &|_, _| Ok(())) {
        Ok(trace) => {
            let text = "the assumptions allow no inputs for the next scan".to_owned();
            Outcome::Violated(Witness { trace, notes: vec![Note { first: last, last, text }] }, None)
        }
        Err(disagreement) => Outcome::refuted(&disagreement.to_string()),
    }
}
