//! Termination check: every scan ends. A program with a loop may never reach its end.

use super::failing::{Failing, failing_scan, what_is_missing};
use super::why::of_error;
use super::{Answer, Outcome};
use crate::scans::{Failure, ScanSpace};
use crate::translate::{PlaceRole, System};
use petril_lang::flat::{FlatProgram, Instruction};
use petril_lang::interpret::{Fault, MAX_STEPS};
use petril_logic::{Bound, Quantifier};
use petril_search::{DeadEnd, Graph, Stop};

/// Builds the answer of the check from its outcome.
pub fn answer(outcome: Outcome) -> Answer {
    Answer::of_check("scan-ends", "Every scan comes to its end.", "AG (scan begins -> AF scan ends)", outcome)
}

/// The check in the transition view, as a formula.
pub fn formula(system: &System) -> Bound {
    let control = |line| Box::new(Bound::Marked(system.place(PlaceRole::Line(line))));
    let ends = Bound::Until {
        quantifier: Quantifier::All,
        weak: false,
        hold: Box::new(Bound::Truth(true)),
        release: control(system.program.end()),
    };
    Bound::Until {
        quantifier: Quantifier::All,
        weak: true,
        hold: Box::new(Bound::Implies(control(0), Box::new(ends))),
        release: Box::new(Bound::Truth(false)),
    }
}

/// The check in the scan view: all reachable scans have been explored.
pub fn on_scans(space: &ScanSpace<'_>, graph: &Graph) -> Outcome {
    match failing_scan(space, graph, |failure| *failure == Failure::Scan(Fault::Endless)) {
        Failing::Shown(witness) => {
            let why = of_error(space.system(), &witness);
            return Outcome::Violated(witness, why);
        }
        Failing::Refuted(disagreement) => {
            return Outcome::Unknown(format!("the replay refutes the search: {disagreement}"));
        }
        Failing::None => {}
    }
    let too_long =
        |&(_, dead_end): &(Option<u32>, DeadEnd)| Failure::of(dead_end) == Some(Failure::Scan(Fault::TooLong));
    if graph.failures().iter().any(too_long) {
        Outcome::Unknown(format!("a scan takes more than {MAX_STEPS} instructions"))
    } else if *graph.stop() != Stop::Complete {
        Outcome::Unknown(format!("{}; the scans explored do end", graph.stop()))
    } else if graph.is_complete() && graph.knows_initial() || !has_loops(&space.system().program) {
        Outcome::holds()
    } else {
        Outcome::Unknown(what_is_missing(graph))
    }
}

/// Whether the program has a backward jump. A program without one terminates whatever it computes.
fn has_loops(program: &FlatProgram) -> bool {
    let mut lines = program.code.iter().enumerate();
    lines.any(|(line, code)| matches!(code.instruction, Instruction::Jump { target, .. } if target <= line))
}
