//! Sanity checks of a specification: what its author may not have meant, decided for all valuations at once.
//!
//! Every finding is proved by the solver; a question that the solver was stopped at is reported as open. A latched or
//! delayed output may differ from its formula, so wherever a formula uses one, all its possible values are considered:
//! no finding depends on an empty latch.
//!
//! ```
//! use petril_spec::sif::{Specification, sanity};
//! use petril_base::source::Source;
//!
//! let text = "restriction R: never a;
//! function F { interface { input a; input b; output f; } formal { f = a & b; } }";
//! let (specification, _) = Specification::read(&[Source::new("f.sif", text)]);
//! let findings = sanity::check(&specification.unwrap(), &sanity::never());
//! assert_eq!(findings[0].doubt, sanity::Doubt::Constant);
//! assert_eq!(findings[0].restrictions, [0]);
//! ```

mod causes;
mod counts;
mod effects;
mod finding;
mod interface;
mod literals;
mod model;
mod outputs;
mod restrictions;
mod same;
mod told;

use std::sync::Arc;

use fixedbitset::FixedBitSet;

pub use counts::{Counts, Excluded, counts};
pub use finding::{Doubt, Example, Finding};

use super::cone::Cone;
use super::solver::Stop;
use super::specification::{Kind, Restriction, Specification};
use effects::Effects;
use model::Model;

/// A [`Stop`] that never stops.
#[must_use]
pub fn never() -> Stop {
    Arc::new(|| false)
}

/// Checks a specification; findings are in the order of the text. `stop` ends the work, and open questions are
/// reported.
///
/// Functions with contradictory restrictions have no test, and nothing else is reported about them.
#[must_use]
pub fn check(specification: &Specification, stop: &Stop) -> Vec<Finding> {
    let (mut findings, consistency) = restrictions::contradictions(specification, stop);
    if consistency.is_broken_everywhere {
        return findings;
    }
    findings.extend(restrictions::implied(specification, &consistency, stop));
    let unused = interface::unused(specification);
    findings.extend(interface::interfaces(specification, &unused));
    let mut effects = Effects::new(specification);
    let mut touched = FixedBitSet::with_capacity(specification.restrictions.len());
    let mut constant = Vec::new();
    let mut is_open = vec![false; specification.functions.len()];
    for (function, is_open) in is_open.iter_mut().enumerate() {
        let mut model = Model::new(specification, cone(specification, function), stop);
        model.restrictions.iter().for_each(|(at, _)| touched.insert(*at));
        if !consistency.is_sound(function) {
            effects.leave_open(&model);
            continue;
        }
        let (found, still) = outputs::constant(&mut model, function);
        findings.extend(found);
        let Some(still) = still else {
            *is_open = true;
            effects.leave_open(&model);
            continue;
        };
        findings.extend(outputs::resets(&mut model, function, &still));
        let (found, removed) = causes::removed(&mut model, function, &still);
        findings.extend(found);
        findings.extend(literals::never_decide(&mut model, function, &still, &removed));
        effects.see(&mut model, function, &still);
        constant.extend(still);
    }
    let without = effects.findings(&unused);
    // An input without effect is reported once, not also for its literals.
    let is_news = |finding: &Finding| {
        let signal = finding.signals.get(1);
        finding.doubt != Doubt::NeverDecides || !without.iter().any(|other| other.signals.first() == signal)
    };
    findings.retain(is_news);
    findings.extend(without);
    findings.extend(restrictions::apart(specification, &touched));
    let is_left = |function: usize| consistency.is_sound(function) && !is_open[function];
    findings.extend(same::outputs(specification, is_left, &constant, stop));
    findings.sort_by_key(|finding| (finding.place.file, finding.place.span.start));
    findings
}

/// Cone of influence of a function's definitions, including the reset conditions of its outputs and of all they use.
fn cone(specification: &Specification, function: usize) -> Cone<'_> {
    let restrictions: Vec<&Restriction> = specification.restrictions_of(function).collect();
    closed(specification, specification.functions[function].equations.clone(), &restrictions)
}

/// Cone of these signals, closed under reset conditions.
fn closed<'s>(
    specification: &'s Specification,
    mut signals: Vec<super::SignalId>,
    restrictions: &[&'s Restriction],
) -> Cone<'s> {
    loop {
        let cone = Cone::of(specification, &signals, restrictions.to_vec());
        let before = signals.len();
        for &id in &cone.definitions {
            if let Kind::Defined { latched: Some(reset), .. } = &specification.signal(id).kind {
                let known = |signal: &super::SignalId| signals.contains(signal);
                let more: Vec<_> = reset.signals().into_iter().filter(|signal| !known(signal)).collect();
                signals.extend(more);
            }
        }
        if signals.len() == before {
            return cone;
        }
    }
}
