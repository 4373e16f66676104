//! Checks that are refused, because something in them was bound for another view or another system.

use super::options::Options;
use super::{Answer, Outcome, Report, asserted};
use crate::requirement::{Demand, misfit};
use crate::translate::System;
use petril_logic::{Bound, FairnessAssumption, Requirement};
use petril_search::{Graph, Parts, Stop};

/// Report in which every answer is unknown, if a formula of the requirements or options does not fit system and view.
pub(super) fn refused(system: &System, requirements: &[(Requirement, Demand)], options: &Options) -> Option<Report> {
    let misfit = |formula: &Bound| misfit(formula, system, options.view);
    let own = |demand: &Demand| demand.formula().and_then(misfit);
    let fairness = options.fairness.iter().flat_map(FairnessAssumption::formulas).find_map(misfit);
    let assumption = options.assumptions.iter().find_map(|assumption| misfit(&assumption.formula));
    let assertion = options.assertions.iter().find_map(|assertion| misfit(&assertion.formula));
    let of_options = [("a fairness assumption", fairness), ("an assumption", assumption), ("an assertion", assertion)];
    let shared = of_options.into_iter().find_map(|(what, reason)| Some(format!("{what} does not fit: {}", reason?)));
    let first = requirements.iter().find_map(|(requirement, demand)| Some((&requirement.name, own(demand)?)));
    let reason =
        shared.or_else(|| first.map(|(name, reason)| format!("the requirement `{name}` does not fit: {reason}")))?;

    let (arena, starts, targets, levels) = (Vec::new(), vec![0], Vec::new(), Vec::new());
    let stop = Stop::Refused(reason.clone());
    let graph = Graph::of_parts(Parts { words: 1, states: 0, arena, starts, targets, levels, stop });
    let outcome = |own: Option<&str>| Outcome::Unknown(own.map_or_else(|| reason.clone(), str::to_owned));
    let required = requirements.iter().map(|(requirement, demand)| Answer::to(requirement, outcome(own(demand))));
    let asserted =
        options.assertions.iter().map(|assertion| asserted::answer(assertion, outcome(misfit(&assertion.formula))));
    Some(Report { answers: required.chain(asserted).collect(), ..options.report(system, requirements, &graph, None) })
}
