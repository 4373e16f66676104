//! Criterion `all`: every allowed valuation or, if wanted, every one that makes an output TRUE.

use fixedbitset::FixedBitSet;

use super::super::diagram::Cube;
use super::super::faults::Model;
use super::super::solver::Answer;
use super::allowed::Allowed;
use super::limits::{Limits, Questions};

/// Upper bound on cubes that summarise valuations too many to list.
const MAX_CUBES: usize = 32;

/// Result of a criterion.
#[derive(Default)]
pub struct Choice {
    /// Tests: valuations of the varied inputs.
    pub tests: Vec<FixedBitSet>,
    /// Purposes of each test; as long as `tests`, or empty.
    pub purposes: Vec<Vec<String>>,
    /// Reason why the tests are incomplete, if so.
    pub incomplete: Option<String>,
    /// Further remarks.
    pub notes: Vec<String>,
    /// Whether the set of tests is proved to be minimum.
    pub is_smallest: bool,
    /// Cubes that summarise valuations too many to list.
    pub cubes: Vec<Cube>,
}

/// Lists all valuations, or all that make an output TRUE. If they are too many, lists none and reports their number.
pub fn all(model: &Model<'_>, allowed: Option<&Allowed>, only_triggering: bool, limits: &Limits) -> Choice {
    let set = allowed.and_then(|sets| Some((sets, sets.tests(only_triggering)?)));
    let mut choice = Choice { is_smallest: true, ..Choice::default() };
    let Some((sets, set)) = set else {
        return listed(model, only_triggering, limits);
    };
    if sets.diagrams.count_if_few(&set).is_some_and(|count| count <= limits.tests as u64) {
        choice.tests = sets.diagrams.valuations(&set).collect();
        return choice;
    }
    let count = about(&sets.diagrams.count(&set));
    choice.incomplete = Some(format!("{count} valuations are more than the {} that are listed", limits.tests));
    choice.cubes = sets.diagrams.cubes(&set).take(MAX_CUBES).collect();
    for cube in &mut choice.cubes {
        cube.zeros.retain(|input| !model.cone.connected.contains(input));
    }
    choice
}

/// Enumeration by a solver, by blocking each model found.
fn listed(model: &Model<'_>, only_triggering: bool, limits: &Limits) -> Choice {
    let mut questions = Questions::new(limits);
    let encoded = model.cone.encode(&mut questions.solver);
    for restriction in &encoded.restrictions {
        questions.solver.require([*restriction]);
    }
    if only_triggering {
        questions.solver.require(model.outputs().iter().map(|output| encoded.literals[output.0]));
    }
    let mut choice = Choice { is_smallest: true, ..Choice::default() };
    let varied = model.specification.valuation(model.cone.inputs.iter().copied());
    loop {
        match questions.ask(&[]) {
            Answer::Unsatisfiable => return choice,
            Answer::Stopped => {
                choice.tests.clear();
                choice.incomplete = Some("they were not all found within the limits".to_owned());
                return choice;
            }
            Answer::Satisfiable if choice.tests.len() >= limits.tests => {
                choice.tests.clear();
                choice.incomplete = Some(format!("they are more than the {} that are listed", limits.tests));
                return choice;
            }
            Answer::Satisfiable => {
                let mut test = encoded.model(&model.cone, &questions.solver);
                test.intersect_with(&varied);
                let other = model.cone.inputs.iter().map(|input| {
                    let literal = encoded.literals[input.0];
                    if test.contains(input.0) { !literal } else { literal }
                });
                questions.solver.require(other);
                choice.tests.push(test);
            }
        }
    }
}

/// A decimal number, or its approximate magnitude if it is long.
#[must_use]
pub fn about(number: &str) -> String {
    match number.split_at_checked(2) {
        Some((first, _)) if number.len() > 15 => {
            let (ones, tenths) = first.split_at(1);
            format!("about {ones}.{tenths}e{}", number.len() - 1)
        }
        _ => number.to_owned(),
    }
}
