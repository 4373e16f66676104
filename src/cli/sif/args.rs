//! The arguments of `petril sif`.

use std::path::PathBuf;

use clap::Subcommand;
use petril::sif::Criterion;

use crate::cli::meaning::Meaning;

/// The verbs on safety functions.
#[derive(Debug, Subcommand)]
pub enum SifVerb {
    /// Check that a specification makes sense: restrictions, unused inputs, functions that never change.
    Check(SifCheck),
    /// Write a specification as requirements, for `petril check`.
    Requirements(SifRequirements),
    /// Run tests of safety functions on a program.
    Run(SifRun),
}

impl SifVerb {
    /// Whether the answer is to be one JSON document.
    pub fn wants_json(&self) -> bool {
        match self {
            Self::Check(arguments) => arguments.json,
            Self::Requirements(_) => false,
            Self::Run(arguments) => arguments.json,
        }
    }
}

/// `petril sif check`
#[derive(Debug, clap::Args)]
pub struct SifCheck {
    /// The specification. Several files are read as one.
    #[arg(value_name = "SPEC", required = true)]
    pub specification: Vec<PathBuf>,
    /// Print one JSON document.
    #[arg(long)]
    pub json: bool,
}

/// `petril sif requirements`
///
/// Restrictions of the whole system become assumptions, those of a zone or a function premises. `petril check` then explores the
/// program's states, on the Petri net too, and decides what is said of time.
#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Example:
  petril sif requirements examples/beam-interlock.sif -o f1.req
  petril check examples/beam-interlock.il --require f1.req")]
pub struct SifRequirements {
    /// The specification. Several files are read as one.
    #[arg(value_name = "SPEC", required = true)]
    pub specification: Vec<PathBuf>,
    /// Where to write; standard output if not given.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// `petril sif run`
///
/// Each test begins with power-on: its inputs are set, a scan is made (or as many as what is delayed needs), and all outputs that
/// the test touches are compared with what the specification says.
#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Exit codes: 0 all tests are passed, 1 some are not, 2 bad usage or input.

Examples:
  petril sif run examples/beam-interlock.sif examples/beam-interlock.il
  petril sif run examples/beam-interlock.sif examples/beam-interlock.il --criterion all --mutants")]
pub struct SifRun {
    /// The specification. Several files are read as one.
    #[arg(value_name = "SPEC", required = true)]
    pub specification: Vec<PathBuf>,
    /// The program.
    #[arg(value_name = "PROGRAM", required = true)]
    pub program: PathBuf,
    /// A function to test, if not all. May be given several times.
    #[arg(long, value_name = "NAME")]
    pub function: Vec<String>,
    /// How tests are chosen.
    #[arg(long, value_name = "NAME", value_parser = criterion, default_value = "faults", conflicts_with = "tests")]
    pub criterion: Criterion,
    /// A table of tests to run instead, as `petril sif tests --csv` writes it. Somebody may have changed it.
    #[arg(long, value_name = "FILE")]
    pub tests: Option<PathBuf>,
    /// Run one test after another without a restart, as on a real plant: latches remember.
    #[arg(long = "continue")]
    pub continued: bool,
    /// Run the tests on programs with one fault each, too, and say which faults they find.
    #[arg(long)]
    pub mutants: bool,
    /// Print one JSON document.
    #[arg(long)]
    pub json: bool,
    /// Write the protocol as one page for a browser, to be read or printed, with the results filled in.
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub html: Option<PathBuf>,
    /// Write the results as JUnit XML, for continuous integration.
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub junit: Option<PathBuf>,
    /// Write a table (CSV) with one row for each test.
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub csv: Option<PathBuf>,
    /// What the PLC does where the standard leaves it open.
    #[command(flatten)]
    pub meaning: Meaning,
}

/// A criterion by its name.
fn criterion(name: &str) -> Result<Criterion, String> {
    let found = Criterion::ALL.into_iter().find(|criterion| criterion.name().eq_ignore_ascii_case(name));
    found.ok_or_else(|| format!("there are {}", Criterion::ALL.map(Criterion::name).join(", ")))
}
