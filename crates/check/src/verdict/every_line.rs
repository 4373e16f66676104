//! The requirement `every line`: each line of the program is executed in some scan.

use super::failing::what_is_missing;
use super::remarks::dead_pieces;
use super::views::{ScanView, SystemView};
use super::{Note, Outcome, Witness};
use crate::scans::never_executed;

/// Looks for dead code: lines that no scan executes.
pub fn outcome(view: &ScanView<'_>) -> Outcome {
    let graph = &view.graph;
    let Some(&first) = graph.initial().first().filter(|_| graph.is_complete()) else {
        return Outcome::Unknown(what_is_missing(graph));
    };
    let never = never_executed(&view.space, graph, &mut || false).unwrap_or_default();
    let never = dead_pieces(&view.system().program, &never);
    if never.is_empty() {
        return Outcome::holds();
    }
    // Dead code has no run of its own, so the shortest run stands in.
    match view.replayed(&[graph.state(first)], None, &|_, _| Ok(())) {
        Ok(trace) => {
            let program = &view.system().program;
            let notes = never.into_iter().map(|line| {
                let instruction = program.text(program.code[line].instruction);
                let words = instruction.split_whitespace().collect::<Vec<_>>().join(" ");
                Note {
                    first: 0,
                    last: 0,
                    text: format!("no scan ever comes to line {} of the flat code (`{words}`)", line + 1),
                }
            });
            Outcome::Violated(Witness { trace, notes: notes.collect() }, None)
        }
        Err(disagreement) => Outcome::refuted(&disagreement.to_string()),
    }
}
