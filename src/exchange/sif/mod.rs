//! Tests of safety functions and their results, in formats for people and programs.

mod told;

pub mod html;
pub mod json;
pub mod junit;
pub mod list;
pub mod plan_csv;
pub mod results_csv;
#[cfg(feature = "spreadsheets")]
pub mod workbook;

use super::Provenance;
use petril_base::source::Source;
use petril_lang::flat::FlatProgram;
use petril_spec::sif::{Excluded, Hunt, Plan, PlanRun, Runner, Specification, Start};

/// Tests of some functions, with everything to report about them.
#[derive(Clone, Copy, Debug)]
pub struct Sheets<'a> {
    /// Specification of the functions.
    pub specification: &'a Specification,
    /// Texts of the specification.
    pub sources: &'a [Source],
    /// Tests, one plan per function.
    pub plans: &'a [Plan],
    /// File that the tests were read from; `None` if they were generated.
    pub origin: Option<&'a str>,
    /// Excluded valuations for each plan; empty if not requested.
    pub excluded: &'a [Excluded],
    /// Results, if the tests were run.
    pub run: Option<Ran<'a>>,
    /// Provenance of the protocol.
    pub provenance: &'a Provenance,
}

/// Test run.
#[derive(Clone, Copy, Debug)]
pub struct Ran<'a> {
    /// Test runner.
    pub runner: &'a Runner<'a>,
    /// Text of the program.
    pub source: &'a Source,
    /// Results of each plan.
    pub results: &'a [PlanRun],
    /// Result of mutation testing, if requested.
    pub hunt: Option<&'a Hunt>,
}

impl<'a> Ran<'a> {
    /// Program under test.
    #[must_use]
    pub fn program(&self) -> &'a FlatProgram {
        self.runner.program()
    }

    /// Number of tests that were passed, failed, and ended in an error.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        let count = |word| self.results.iter().flat_map(|run| &run.tests).filter(|t| t.ending.word() == word).count();
        ["passed", "failed", "error"].map(count)
    }

    /// Initial state of tests, in one word.
    #[must_use]
    pub fn mode(&self) -> &'static str {
        match self.runner.start() {
            Start::PowerOn => "power-on",
            Start::Continued => "continued",
        }
    }
}

impl Sheets<'_> {
    /// Number of tests.
    #[must_use]
    pub fn tests(&self) -> usize {
        self.plans.iter().map(|plan| plan.tests.len()).sum()
    }
}

pub use told::{brief, reasons};
