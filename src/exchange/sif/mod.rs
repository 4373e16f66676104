//! Tests of safety functions, and what became of them, in forms for people and programs.

mod told;

pub mod html;
pub mod json;
pub mod junit;
pub mod list;
pub mod plan_csv;
pub mod results_csv;

use super::Provenance;
use crate::sif::{Excluded, Hunt, Plan, PlanRun, Runner, Specification, Start};
use petril_base::source::Source;
use petril_lang::flat::FlatProgram;

/// Tests of some functions, with all there is to tell of them.
#[derive(Clone, Copy, Debug)]
pub struct Sheets<'a> {
    /// What the functions are.
    pub specification: &'a Specification,
    /// The texts it was read from.
    pub sources: &'a [Source],
    /// The tests, function after function.
    pub plans: &'a [Plan],
    /// The file that the tests were read from; nothing if they were made by their criteria.
    pub origin: Option<&'a str>,
    /// What is left out of each plan; empty if nobody asked.
    pub excluded: &'a [Excluded],
    /// What became of the tests, if they were run.
    pub run: Option<Ran<'a>>,
    /// Where all this comes from.
    pub provenance: &'a Provenance,
}

/// A run of tests.
#[derive(Clone, Copy, Debug)]
pub struct Ran<'a> {
    /// What ran them.
    pub runner: &'a Runner<'a>,
    /// The text of the program.
    pub source: &'a Source,
    /// What became of the tests of each plan.
    pub results: &'a [PlanRun],
    /// Which faults of the program they find, if that was asked for.
    pub hunt: Option<&'a Hunt>,
}

impl<'a> Ran<'a> {
    /// The program.
    #[must_use]
    pub fn program(&self) -> &'a FlatProgram {
        self.runner.program()
    }

    /// How many tests were passed, failed, and ended in an error.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        let count = |word| self.results.iter().flat_map(|run| &run.tests).filter(|t| t.ending.word() == word).count();
        ["passed", "failed", "error"].map(count)
    }

    /// What tests begin with, in a word.
    #[must_use]
    pub fn mode(&self) -> &'static str {
        match self.runner.start() {
            Start::PowerOn => "power-on",
            Start::Continued => "continued",
        }
    }
}

impl Sheets<'_> {
    /// How many tests there are.
    #[must_use]
    pub fn tests(&self) -> usize {
        self.plans.iter().map(|plan| plan.tests.len()).sum()
    }
}

pub use told::{brief, reasons};
