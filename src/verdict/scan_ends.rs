//! The check that every scan ends, made without asking: a program with a loop may never come to its end.

use super::{Answer, Outcome, Trace, Witness};
use crate::explore::{Failure, Graph, ScanSpace};
use crate::interpret::{Fault, MAX_STEPS};
use crate::logic::{Bound, Quantifier};
use crate::translate::{PlaceRole, System};
use crate::verdict::Note;
use crate::witness::{replay_scans, scan_trace};

/// The check with its outcome.
pub fn answer(outcome: Outcome) -> Answer {
    Answer {
        name: "scan-ends".to_owned(),
        sentence: Some("Every scan comes to its end.".to_owned()),
        formula: "AG (scan begins -> AF scan ends)".to_owned(),
        outcome,
    }
}

/// The check in the transition view.
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

/// The check in the scan view: the search has met every scan there is.
pub fn on_scans(system: &System, graph: &Graph) -> Outcome {
    // A scan that never ends says more than one nobody waited for.
    let endless = |(_, failure): &&(Option<u32>, Failure)| *failure == Failure::Scan(Fault::Endless);
    let failures = graph.failures();
    let Some(&(state, failure)) = failures.iter().find(endless).or(failures.first()) else {
        return if graph.is_complete() {
            Outcome::Holds { vacuous: None, witness: None }
        } else {
            Outcome::Unknown(format!("{}; the scans explored do end", graph.stop()))
        };
    };
    if failure == Failure::Scan(Fault::TooLong) {
        return Outcome::Unknown(format!("a scan takes more than {MAX_STEPS} instructions"));
    }
    let space = ScanSpace::new(system);
    let path = state.map(|state| graph.path_to(state)).unwrap_or_default();
    let states: Vec<&[u64]> = path.iter().map(|&state| graph.state(state)).collect();
    let trace = scan_trace(&space, &states, None, true);
    let last = trace.scans.len() - 1;
    match replay_scans(system, &trace, |_, _| Ok(())) {
        Ok(()) => {
            let text = "this scan never ends: it repeats a state".to_owned();
            Outcome::Violated(Witness { trace: Trace::Scans(trace), notes: vec![Note { first: last, last, text }] })
        }
        Err(disagreement) => Outcome::Unknown(format!("the replay refutes the search: {disagreement}")),
    }
}
