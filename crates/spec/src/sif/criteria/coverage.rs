//! Mutation score of tests: which single faults they find, which they miss, and why.

use fixedbitset::FixedBitSet;

use super::super::faults::{Class, Fault, Model, View, described};
use super::super::plan::{ClassCoverage, Coverage, Missed};
use super::completion::Completion;
use super::pool::{Pool, Sight};

/// Upper bound on missed faults listed individually.
const MAX_MISSED: usize = 1000;

/// Measures tests, given as sets of inputs that are TRUE.
pub fn coverage(
    model: &Model<'_>,
    faults: &[Fault],
    pool: &Pool,
    completion: &mut Completion<'_>,
    tests: &[FixedBitSet],
) -> Coverage {
    let views: Vec<(View<u64>, u64)> =
        tests.chunks(64).map(|batch| (View::of(model, batch), u64::MAX >> (64 - batch.len()))).collect();
    let is_killed = |fault: &Fault| views.iter().any(|(view, used)| view.kills(model, fault) & used != 0);
    let triggers = |view: &View<u64>| model.outputs().iter().fold(0, |any, output| any | view.signals[output.0]);
    let expected = Expected {
        all: views.iter().all(|(view, used)| triggers(view) & used == *used),
        none: views.iter().all(|(view, used)| triggers(view) & used == 0),
    };
    let mut coverage = Coverage::default();
    let mut triggering = FixedBitSet::with_capacity(pool.tests.len());
    for (number, batch) in pool.tests.chunks(64).enumerate() {
        let word = triggers(&View::of(model, batch));
        (0..batch.len()).filter(|bit| word >> bit & 1 == 1).for_each(|bit| triggering.insert(number * 64 + bit));
    }
    for class in Class::ALL {
        let mut of = ClassCoverage { class: class.name(), faults: 0, equivalent: 0, killed: 0, undecided: 0 };
        let faults = faults.iter().enumerate().filter(|(_, fault)| fault.class == class);
        for (at, fault) in faults {
            of.faults += 1;
            match pool.sights[at] {
                Sight::Equivalent => of.equivalent += 1,
                Sight::Shown if is_killed(fault) => of.killed += 1,
                Sight::Undecided => of.undecided += 1,
                Sight::Shown if coverage.missed.len() < MAX_MISSED => {
                    let Some(shown_by) = shown_by(model, pool, completion, at) else { continue };
                    let why = expected.why(model, &views, fault, &pool.rows[at], &triggering, pool.is_all);
                    let fault = described(model, fault);
                    coverage.missed.push(Missed { class: class.name(), fault, shown_by, why });
                }
                Sight::Shown => {}
            }
        }
        coverage.classes.push(of);
    }
    coverage
}

/// A complete test that shows a fault.
fn shown_by(model: &Model<'_>, pool: &Pool, completion: &mut Completion<'_>, fault: usize) -> Option<FixedBitSet> {
    let inputs = pool.rows[fault].ones().find_map(|test| completion.complete(&pool.tests[test]))?;
    Some(model.specification.settled(&inputs))
}

/// Expected outputs of a set of tests.
struct Expected {
    /// Whether every test makes an output TRUE.
    all: bool,
    /// Whether no test makes an output TRUE.
    none: bool,
}

impl Expected {
    /// Reason why no test shows a fault.
    fn why(
        &self,
        model: &Model<'_>,
        views: &[(View<u64>, u64)],
        fault: &Fault,
        row: &FixedBitSet,
        triggering: &FixedBitSet,
        is_all: bool,
    ) -> String {
        if views.is_empty() {
            return "there is no test".to_owned();
        }
        let several = model.outputs().len() > 1;
        if is_all && self.all && row.is_disjoint(triggering) {
            let text = "all tests expect TRUE, and this fault is only seen where FALSE is right";
            let of_several = "each test makes an output TRUE, and this fault is only seen where none is";
            return if several { of_several } else { text }.to_owned();
        }
        if is_all && self.none && row.is_subset(triggering) {
            let text = "all tests expect FALSE, and this fault is only seen where TRUE is right";
            let of_several = "no test makes an output TRUE, and this fault is only seen where one is";
            return if several { of_several } else { text }.to_owned();
        }
        let changed: u32 = views.iter().map(|(view, used)| (view.changes(model, fault) & used).count_ones()).sum();
        match changed {
            0 => "in no test does this place have another value with the fault".to_owned(),
            1 => "in one test this place has another value with the fault, but the rest of the formula hides it"
                .to_owned(),
            _ => format!(
                "in {changed} tests this place has another value with the fault, but the rest of the formula hides it"
            ),
        }
    }
}
