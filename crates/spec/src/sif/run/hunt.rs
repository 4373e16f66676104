//! Mutation testing of a program: which of its faults the tests find.

use rayon::prelude::*;

use super::Runner;
use super::mutants::Mutant;
use crate::sif::Plan;
use petril_lang::flat::{FlatProgram, Target};
use petril_lang::semantics::VarId;

/// Fate of a mutant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fate {
    /// Killed: a test is not passed; position of its plan, and of the test.
    Found(usize, usize),
    /// Equivalent: no test can find it, since it computes the specification.
    Equivalent,
    /// Survived, although it differs from the specification.
    Missed,
    /// Survived, and for this reason it is not known whether it is equivalent.
    Undecided(String),
}

/// Decides whether a program that passes all tests computes its specification.
pub type Decide<'d> = dyn Fn(&FlatProgram) -> Fate + Sync + 'd;

/// Result of mutation testing.
#[derive(Clone, Debug, Default)]
pub struct Hunt {
    /// Mutants with their fates, in the order of the program.
    pub mutants: Vec<(Mutant, Fate)>,
}

impl Hunt {
    /// Number of mutants of a class, or of all classes: all, found, equivalent, missed, undecided.
    #[must_use]
    pub fn counts(&self, class: Option<&str>) -> [usize; 5] {
        let mut counts = [0; 5];
        for (_, fate) in self.mutants.iter().filter(|(mutant, _)| class.is_none_or(|class| mutant.class == class)) {
            counts[0] += 1;
            counts[match fate {
                Fate::Found(..) => 1,
                Fate::Equivalent => 2,
                Fate::Missed => 3,
                Fate::Undecided(_) => 4,
            }] += 1;
        }
        counts
    }
}

/// Runs the tests on all mutants. Survivors are decided by `decide`. `stop` is called before each mutant; those left
/// when it returns true are undecided.
#[must_use]
pub fn hunt(
    runner: &Runner<'_>,
    plans: &[Plan],
    mutants: Vec<Mutant>,
    decide: &Decide<'_>,
    stop: &(dyn Fn() -> bool + Sync),
) -> Hunt {
    // Most mutants are killed by the tests of the function whose output is written next.
    let written: Vec<Option<usize>> = plans.iter().map(|plan| written(runner, plan)).collect();
    let nearest = |line: usize| {
        let behind = (0..plans.len()).filter(|&plan| written[plan].is_some_and(|written| written >= line));
        behind.min_by_key(|&plan| written[plan]).unwrap_or(0)
    };
    let fates = mutants.into_par_iter().map(|mutant| {
        if stop() {
            return (mutant, Fate::Undecided("the work was stopped".to_owned()));
        }
        let program = mutant.of(runner.program());
        let found = runner.with(&program).first_not_passed(plans, nearest(mutant.line));
        let fate = found.map_or_else(|| decide(&program), |(plan, test)| Fate::Found(plan, test));
        (mutant, fate)
    });
    Hunt { mutants: fates.collect() }
}

/// Last line that writes an output of a plan's function.
fn written(runner: &Runner<'_>, plan: &Plan) -> Option<usize> {
    let outputs = &runner.specification().functions[plan.function].outputs;
    let variables: Vec<VarId> = outputs.iter().filter_map(|output| runner.variable(*output)).collect();
    let is_one = |target| matches!(target, Target::Variable(id) if variables.contains(&id));
    runner.program().code.iter().rposition(|line| line.instruction.writes().is_some_and(is_one))
}
