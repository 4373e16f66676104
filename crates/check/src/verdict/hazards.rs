//! Built-in checks for run-time errors: one for each kind of hazard that the program's instructions can meet, unless it
//! is tolerated.

use super::failing::{Failing, failing_scan};
use super::why::of_error;
use super::{Answer, Outcome};
use crate::scans::{Failure, ScanSpace};
use crate::translate::{PlaceRole, System};
use petril_lang::flat::{FlatProgram, Hazard, Tolerated};
use petril_logic::{Bound, Quantifier};
use petril_search::Graph;

/// Hazards to check in a program.
pub fn checked(program: &FlatProgram, tolerated: Tolerated) -> impl Iterator<Item = Hazard> {
    program.hazards().into_iter().filter(move |&hazard| !tolerated.allows(hazard))
}

/// Builds the answer of a check from its outcome.
pub fn answer(hazard: Hazard, outcome: Outcome) -> Answer {
    let (sentence, formula) = match hazard {
        Hazard::Overflow => ("No number is too large or too small for its type.", "AG !overflow"),
        Hazard::DivisionByZero => ("No divisor is 0.", "AG !division-by-zero"),
        Hazard::Index => ("Every index lies within its array.", "AG !index-outside"),
        Hazard::Subrange => ("Every variable stays within its subrange.", "AG !subrange-left"),
    };
    Answer::of_check(&hazard.to_string(), sentence, formula, outcome)
}

/// The check in the transition view: control never reaches a place of the hazard. In this view the program continues
/// after a hazard.
pub fn formula(system: &System, hazard: Hazard) -> Bound {
    let places = (0..system.program.end()).filter_map(|line| system.find(PlaceRole::Hazard(line, hazard)));
    let met = places.map(Bound::Marked).reduce(|f, g| Bound::Or(Box::new(f), Box::new(g)));
    Bound::Until {
        quantifier: Quantifier::All,
        weak: true,
        hold: Box::new(Bound::Not(Box::new(met.unwrap_or(Bound::Truth(false))))),
        release: Box::new(Bound::Truth(false)),
    }
}

/// The check in the scan view: every scan up to the first error has been explored.
pub fn on_scans(space: &ScanSpace<'_>, graph: &Graph, hazard: Hazard) -> Outcome {
    let met = |failure: &Failure| matches!(failure, Failure::Hazard(_, met) if *met == hazard);
    match failing_scan(space, graph, met) {
        Failing::None if graph.is_complete() && graph.knows_initial() => Outcome::holds(),
        Failing::None => Outcome::Unknown(super::failing::what_is_missing(graph)),
        Failing::Shown(witness) => {
            let why = of_error(space.system(), &witness);
            Outcome::Violated(witness, why)
        }
        Failing::Refuted(disagreement) => Outcome::refuted(&disagreement.to_string()),
    }
}
