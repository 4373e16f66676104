//! Tests excluded by restrictions.

use std::collections::HashMap;

use fixedbitset::FixedBitSet;
use rustc_hash::FxBuildHasher;

use super::super::cone::{Cone, Encoded};
use super::super::diagram::{Diagram, Diagrams};
use super::super::formula::SignalId;
use super::super::plan::Excluded;
use super::super::solver::{Answer, Literal};
use super::super::specification::Specification;
use super::allowed::Allowed;
use super::limits::{Limits, Questions};

/// Upper bound on cubes that summarise valuations too many to list.
const MAX_CUBES: usize = 32;

/// Valuations that make an output of a function TRUE but are not allowed, with the restrictions that exclude them. Only
/// restrictions that concern the function's inputs are considered.
#[must_use]
pub fn excluded(specification: &Specification, function: usize, limits: &Limits) -> Excluded {
    let outputs = &specification.functions[function].outputs;
    let cone = Cone::of(specification, outputs, specification.restrictions_of(function).collect());
    let all = Diagrams::over(cone.inputs.clone(), specification.signals.len(), limits.nodes);
    let mut found = Excluded {
        varied: cone.inputs.clone(),
        valuations: all.map_or_else(String::new, |all| all.count(&all.constant(true))),
        triggering: None,
        excluded: None,
        by_restriction: Vec::new(),
        listed: None,
        cubes: Vec::new(),
    };
    if let Some(sets) = Allowed::of(&cone, outputs, limits, true) {
        // All counts are reported, or none.
        if let Some(counted) = counted(&cone, &sets, limits, &found) {
            found = counted;
        }
    }
    found
}

/// Counts the excluded valuations; `None` if a diagram becomes too large.
fn counted(cone: &Cone<'_>, sets: &Allowed, limits: &Limits, of: &Excluded) -> Option<Excluded> {
    let specification = cone.specification;
    let diagrams = &sets.diagrams;
    let among = |set: &Diagram| diagrams.and(&sets.triggering, set);
    let excluded = among(&sets.allowed.complement())?;
    let mut found = of.clone();
    found.triggering = Some(diagrams.count(&sets.triggering));
    found.excluded = Some(diagrams.count(&excluded));
    let is_few = diagrams.count_if_few(&excluded).is_some_and(|count| count <= limits.tests as u64);
    let mut alone: HashMap<FixedBitSet, Vec<usize>, FxBuildHasher> = HashMap::default();
    for (restriction, (its, without)) in cone.restrictions.iter().zip(&sets.restrictions) {
        let Some(position) = specification.restrictions.iter().position(|other| std::ptr::eq(other, *restriction))
        else {
            continue;
        };
        let its = among(its)?;
        // Valuations excluded by this restriction only.
        let only = diagrams.and(&excluded, without)?;
        if its.is_empty() && only.is_empty() {
            continue;
        }
        found.by_restriction.push((position, diagrams.count(&its), diagrams.count(&only)));
        if is_few {
            diagrams.valuations(&its).for_each(|valuation| alone.entry(valuation).or_default().push(position));
        }
    }
    if is_few {
        let mut together = Together::new(cone, limits);
        let listed = diagrams.valuations(&excluded).map(|valuation| {
            let by = alone.remove(&valuation).unwrap_or_else(|| together.exclude(&valuation));
            (valuation, by)
        });
        found.listed = Some(listed.collect());
    } else {
        found.cubes = diagrams.cubes(&excluded).take(MAX_CUBES).collect();
        for cube in &mut found.cubes {
            cube.zeros.retain(|input| !cone.connected.contains(input));
        }
    }
    Some(found)
}

/// Finder of restrictions that exclude a valuation jointly.
struct Together<'c> {
    cone: &'c Cone<'c>,
    questions: Questions,
    encoded: Encoded,
}

impl<'c> Together<'c> {
    fn new(cone: &'c Cone<'c>, limits: &Limits) -> Self {
        let mut questions = Questions::new(limits);
        let encoded = cone.encode(&mut questions.solver);
        Self { cone, questions, encoded }
    }

    /// Positions of a minimal set of restrictions that excludes the valuation.
    fn exclude(&mut self, valuation: &FixedBitSet) -> Vec<usize> {
        let literal = |input: &SignalId| {
            let literal = self.encoded.literals[input.0];
            if valuation.contains(input.0) { literal } else { !literal }
        };
        let fixed: Vec<Literal> = self.cone.inputs.iter().map(literal).collect();
        let mut kept: Vec<usize> = (0..self.cone.restrictions.len()).collect();
        for restriction in 0..self.cone.restrictions.len() {
            let others =
                kept.iter().filter(|other| **other != restriction).map(|other| self.encoded.restrictions[*other]);
            let assumed: Vec<Literal> = fixed.iter().copied().chain(others).collect();
            if self.questions.ask(&assumed) == Answer::Unsatisfiable {
                kept.retain(|other| *other != restriction);
            }
        }
        let all = &self.cone.specification.restrictions;
        let place = |at: usize| all.iter().position(|other| std::ptr::eq(other, self.cone.restrictions[at]));
        kept.into_iter().filter_map(place).collect()
    }
}
