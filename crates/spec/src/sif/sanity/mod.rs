//! Whether a specification makes sense: what its author may not have meant, decided for all valuations at once.
//!
//! Everything that is said was proved by the solver; a question that it was stopped at is said to be open. What is latched or
//! delayed may have other values than its formula, so wherever a formula uses such an output, it is taken to have any value
//! that it can have: nothing is said that is only so as long as nothing is remembered.
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

/// Never stops the work.
#[must_use]
pub fn never() -> Stop {
    Arc::new(|| false)
}

/// All that is doubtful in a specification, in the order of the text. `stop` ends the work: what is open then is said to be.
///
/// Where restrictions contradict each other, whatever they restrict has no test, and nothing else is said of it.
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
    // A literal of an input that makes no difference anywhere is no news.
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

/// What matters to a function: to what it defines, and to the resets of its outputs and of what they use.
fn cone(specification: &Specification, function: usize) -> Cone<'_> {
    let restrictions: Vec<&Restriction> = specification.restrictions_of(function).collect();
    closed(specification, specification.functions[function].equations.clone(), &restrictions)
}

/// The cone of these signals, and of the resets of all that is latched in it.
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
