//! Cache of outcomes: requirements decided by an earlier check are not decided again.
//!
//! Outcomes apply only to the same system under the same options ([`fingerprint()`]). A verdict `holds` rests on the
//! check that found it; a run is replayed before it is reported again, and decided anew if the replay fails.

mod confirm;
mod fingerprint;

use std::collections::BTreeMap;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

pub use fingerprint::fingerprint;

use super::assumptions::assumptions;
use super::check::{answer, answers, asked, check_aloud};
use super::coverage::coverage;
use super::news::{InOrder, News, Tell};
use super::{Answer, Exploration, Options, Outcome, Remark, Report, asserted};
use crate::requirement::Demand;
use crate::translate::System;
use confirm::{is_about, is_confirmed};
use fingerprint::of_demand;
use petril_logic::{Requirement, View};
use petril_search::Progress;

/// Outcomes of checks of one system under given options.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Known {
    exploration: Exploration,
    /// Assumptions found only by the search (states left out by fairness).
    found_assumptions: Vec<String>,
    /// Fingerprints of the requirements of the last check.
    asked: Vec<String>,
    /// Outcomes of assertions, in their order.
    asserted: Vec<Outcome>,
    /// Answers of built-in checks.
    checks: Vec<Answer>,
    remarks: Vec<Remark>,
    /// Lines that no scan executes, if known.
    never_executed: Option<Vec<usize>>,
    /// Outcomes of requirements by fingerprint.
    outcomes: BTreeMap<String, Outcome>,
}

/// Decides requirements as [`check()`](super::check()) does, except those with a cached outcome. If all have one,
/// nothing is explored.
///
/// `known` must come from a system with the same [`fingerprint()`]. Returns the updated cache, unless `watch` has ended
/// the search: then outcomes depend on more than the system.
#[must_use]
pub fn check_knowing(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    known: Option<&Known>,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
) -> (Report, Option<Known>) {
    check_knowing_aloud(system, requirements, options, known, watch, None)
}

/// As [`check_knowing()`]; `tell` receives the exploration and each answer, as with [`check_aloud()`], and is not
/// called if nothing is explored.
#[must_use]
pub fn check_knowing_aloud(
    system: &System,
    requirements: &[(Requirement, Demand)],
    options: &Options,
    known: Option<&Known>,
    watch: &mut dyn FnMut(&Progress) -> Option<String>,
    tell: Option<Tell<'_>>,
) -> (Report, Option<Known>) {
    let demands: Vec<String> = requirements.iter().map(|(_, demand)| of_demand(demand)).collect();
    // States left out by fairness are reported for all requirements together: then all are cached, or none.
    let together = !options.fairness.is_empty();
    let known = known.filter(|known| known.is_about(system, options) && !(together && known.asked != demands));
    let recall = |((_, demand), fingerprint): (&(Requirement, Demand), &String)| {
        known.and_then(|known| known.outcome(system, demand, fingerprint))
    };
    let mut recalled: Vec<Option<Outcome>> = requirements.par_iter().zip(&demands).map(recall).collect();
    if together && recalled.iter().any(Option::is_none) {
        recalled.fill(None);
    }
    let missing: Vec<(Requirement, Demand)> =
        requirements.iter().zip(&recalled).filter(|(_, outcome)| outcome.is_none()).map(|(r, _)| r.clone()).collect();
    if let (Some(known), []) = (known, missing.as_slice()) {
        return (known.report(system, requirements, options, recalled.into_iter().flatten().collect()), None);
    }
    let mut was_stopped = false;
    let mut watch = |progress: &Progress| {
        let reason = watch(progress);
        was_stopped |= reason.is_some();
        reason
    };
    let told = InOrder::new(tell);
    let positions = |is_known: bool| (0..).zip(&recalled).filter(move |(_, outcome)| outcome.is_some() == is_known);
    let tell_all = |news: News<'_>| match news {
        News::Explored(found) => {
            told.begin(|| {
                let own = assumptions(system, options, is_timed(requirements)).into_iter();
                let assumptions = own.chain(found_assumptions(system, options, &missing, found)).collect();
                Report { assumptions, ..found.clone() }
            });
            for (position, outcome) in positions(true) {
                let outcome = outcome.clone().unwrap_or_else(Outcome::holds);
                let answer = || answer(system, &requirements[position], options, outcome);
                told.put(position, || Answer { recalled: true, ..answer() });
            }
        }
        News::Answered(among_missing, answer) => {
            if let Some((position, _)) = positions(false).nth(among_missing) {
                told.put(position, || answer.clone());
            }
        }
    };
    let tell_all: Option<Tell<'_>> = tell.is_some().then_some(&tell_all);
    let found = check_aloud(system, &missing, options, &mut watch, tell_all);
    let mut now = Known::new(system, &missing, options, &found);
    now.asked = demands;
    let of_missing = found.answers.into_iter().map(|answer| answer.outcome).take(missing.len());
    let is_recalled: Vec<bool> = recalled.iter().map(Option::is_some).collect();
    let mut of_missing = of_missing.collect::<Vec<_>>().into_iter();
    let outcomes = recalled.into_iter().filter_map(|outcome| outcome.or_else(|| of_missing.next())).collect();
    let mut report = now.report(system, requirements, options, outcomes);
    for (answer, is_recalled) in report.answers.iter_mut().zip(is_recalled) {
        answer.recalled = is_recalled;
    }
    report.answers[requirements.len()..].iter_mut().for_each(|answer| answer.recalled = false);
    report.checks.iter_mut().for_each(|answer| answer.recalled = false);
    report.exploration.recalled = false;
    if let Some(known) = known {
        for (fingerprint, outcome) in &known.outcomes {
            now.outcomes.entry(fingerprint.clone()).or_insert_with(|| outcome.clone());
        }
    }
    (report, (!was_stopped).then_some(now))
}

impl Known {
    /// Collects the outcomes of a report on these requirements.
    fn new(system: &System, requirements: &[(Requirement, Demand)], options: &Options, report: &Report) -> Self {
        let outcome = |answer: &Answer| answer.outcome.clone();
        let (asked, asserted) = report.answers.split_at(requirements.len());
        let demands: Vec<String> = requirements.iter().map(|(_, demand)| of_demand(demand)).collect();
        Self {
            exploration: report.exploration.clone(),
            found_assumptions: found_assumptions(system, options, requirements, report),
            asserted: asserted.iter().map(outcome).collect(),
            checks: report.checks.clone(),
            remarks: report.remarks.clone(),
            never_executed: report.coverage.as_ref().and_then(|coverage| coverage.never_executed.clone()),
            outcomes: demands.iter().cloned().zip(asked.iter().map(outcome)).collect(),
            asked: demands,
        }
    }

    /// Whether the cached data can be about the system at all; it may be damaged.
    fn is_about(&self, system: &System, options: &Options) -> bool {
        let mut lines = self.never_executed.iter().flatten();
        self.asserted.len() == options.assertions.len()
            && self.exploration.view == options.view
            && self.remarks.iter().all(|remark| is_about(system, remark))
            && lines.all(|&line| line < system.program.end())
            && self.asserted.iter().all(|outcome| is_confirmed(system, None, outcome))
            && self.checks.iter().all(|check| is_confirmed(system, None, &check.outcome))
    }

    /// Cached outcome of a requirement, its runs replayed.
    fn outcome(&self, system: &System, demand: &Demand, fingerprint: &str) -> Option<Outcome> {
        let outcome = self.outcomes.get(fingerprint)?;
        is_confirmed(system, demand.formula(), outcome).then(|| outcome.clone())
    }

    /// Builds the report from cached data and these outcomes.
    fn report(
        &self,
        system: &System,
        requirements: &[(Requirement, Demand)],
        options: &Options,
        outcomes: Vec<Outcome>,
    ) -> Report {
        let recalled = |answer: Answer| Answer { recalled: true, ..answer };
        let asserted =
            options.assertions.iter().zip(&self.asserted).map(|(a, outcome)| asserted::answer(a, outcome.clone()));
        let scans = options.view == View::Scan;
        Report {
            exploration: Exploration { recalled: true, ..self.exploration.clone() },
            assumptions: assumptions(system, options, is_timed(requirements))
                .into_iter()
                .chain(self.found_assumptions.iter().cloned())
                .collect(),
            warnings: Vec::new(),
            answers: answers(system, requirements, options, outcomes)
                .into_iter()
                .chain(asserted)
                .map(recalled)
                .collect(),
            checks: self.checks.iter().cloned().map(recalled).collect(),
            remarks: self.remarks.clone(),
            coverage: scans.then(|| coverage(system, asked(requirements, options), self.never_executed.clone())),
        }
    }
}

/// Assumptions of a report that only the search finds.
fn found_assumptions(
    system: &System,
    options: &Options,
    requirements: &[(Requirement, Demand)],
    report: &Report,
) -> Vec<String> {
    let known = assumptions(system, options, is_timed(requirements));
    report.assumptions.iter().filter(|found| !known.contains(found)).cloned().collect()
}

/// Whether some requirement mentions time.
fn is_timed(requirements: &[(Requirement, Demand)]) -> bool {
    requirements.iter().any(|(requirement, _)| requirement.speaks_of_time())
}
