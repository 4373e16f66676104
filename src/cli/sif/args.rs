//! Arguments of `petril sif`.

use std::path::PathBuf;
use std::time::Duration;

use clap::Subcommand;
use petril::sif::Criterion;

use crate::cli::bounds::Bounds;
use crate::cli::meaning::Meaning;

/// The verbs on safety functions.
#[derive(Debug, Subcommand)]
pub enum SifVerb {
    /// Check that a specification makes sense: restrictions, unused inputs, functions that never change.
    Check(SifCheck),
    /// Tell which triggering valuations restrictions exclude from the tests.
    Excluded(SifExcluded),
    /// Write the frame of a specification, from a list of inputs and outputs.
    Import(SifImport),
    /// Prove that a program computes what is specified, or show the scans in which it does not.
    Prove(SifProve),
    /// Write a specification as requirements, for `petril check`.
    Requirements(SifRequirements),
    /// Run tests of safety functions on a program.
    Run(SifRun),
    /// Make tests of safety functions, and say which faults they find.
    Tests(SifTests),
}

impl SifVerb {
    /// Whether to print one JSON document.
    pub fn wants_json(&self) -> bool {
        match self {
            Self::Check(arguments) => arguments.json,
            Self::Prove(arguments) => arguments.json,
            Self::Excluded(_) | Self::Import(_) | Self::Requirements(_) => false,
            Self::Run(arguments) => arguments.json,
            Self::Tests(arguments) => arguments.json,
        }
    }

    /// Resource limits.
    pub fn bounds(&self) -> Bounds {
        match self {
            // Questions a solver does not decide within a minute are reported as undecided.
            Self::Check(SifCheck { bounds, .. }) => {
                Bounds { timeout: bounds.timeout.or(Some(Duration::from_secs(60))), ..*bounds }
            }
            Self::Excluded(arguments) => arguments.bounds,
            Self::Import(arguments) => arguments.bounds,
            Self::Prove(arguments) => arguments.bounds,
            Self::Requirements(arguments) => arguments.bounds,
            Self::Run(arguments) => arguments.bounds,
            Self::Tests(arguments) => arguments.bounds,
        }
    }

    /// Whether the verb has a verdict, which can be incomplete.
    pub fn has_verdict(&self) -> bool {
        matches!(self, Self::Check(_) | Self::Prove(_) | Self::Run(_) | Self::Tests(_))
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
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
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
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
}

/// `petril sif prove`
///
/// Each output at the end of every scan is its formula over the inputs of that scan, as long as these keep the restrictions. What differs is
/// shown as a run from power-on, which the interpreter has replayed. Of delayed outputs it is proved that they never come without their
/// formula, not that they come in time: for that, see `petril sif requirements`.
#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Exit codes: 0 everything is proved, 1 something is refuted, 2 the files cannot be used, 3 something is unknown.

Example:
  petril sif prove examples/beam-interlock.sif examples/beam-interlock.il")]
pub struct SifProve {
    /// The specification, in one file or several, and last the program: Instruction List, or a PLCopen project in XML.
    #[arg(value_name = "FILE", required = true, num_args = 2..)]
    pub files: Vec<PathBuf>,
    /// Prove only the outputs of this function.
    #[arg(short, long, value_name = "NAME")]
    pub function: Vec<String>,
    /// What the program means on the PLC it runs on.
    #[command(flatten)]
    pub meaning: Meaning,
    /// How many scans runs and inductions may have.
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub scans: u16,
    /// Print one JSON document.
    #[arg(long)]
    pub json: bool,
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
}

/// `petril sif run`
///
/// Each test begins with power-on: its inputs are set, a scan is made (or as many as what is delayed needs), and all outputs that
/// the test touches are compared with what the specification says.
#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Exit codes: 0 all tests are passed, 1 some are not, 2 bad usage or input, 3 a limit was reached before all faults were tried.

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
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
}

/// `petril sif tests`
///
/// A fault is a change in one place of one equation: a literal negated, missing, added or another one, an operator exchanged, a part that
/// is always TRUE or FALSE, and so on. Of each class it is said how many there are, how many nothing can show, and how many the tests find.
#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Criteria:
  all       every valuation that can be and makes an output TRUE
  all-both  every valuation that can be
  mcdc      each condition decides its outcome, once TRUE and once FALSE
  faults    few tests that find every fault that can be seen
  pairs     every two inputs have all values together that they can have

Exit codes: 0 these are the tests, 2 bad usage or input, 3 they are not all, and it is said why.

Examples:
  petril sif tests examples/beam-interlock.sif
  petril sif tests examples/beam-interlock.sif --compare
  petril sif tests examples/beam-interlock.sif --criterion all --html protocol.html")]
pub struct SifTests {
    /// The specification. Several files are read as one.
    #[arg(value_name = "SPEC", required = true)]
    pub specification: Vec<PathBuf>,
    /// A function to make tests of, if not all. May be given several times.
    #[arg(short, long, value_name = "NAME")]
    pub function: Vec<String>,
    /// How tests are chosen.
    #[arg(long, value_name = "NAME", value_parser = criterion, default_value = "faults", conflicts_with_all = ["tests", "compare"])]
    pub criterion: Criterion,
    /// A table of tests to judge instead, as `--csv` writes it.
    #[arg(long, value_name = "FILE", conflicts_with = "compare")]
    pub tests: Option<PathBuf>,
    /// Compare all criteria: tests, and faults they find.
    #[arg(long, conflicts_with_all = ["json", "html", "csv"])]
    pub compare: bool,
    /// List at most so many tests of a function; if a criterion has more, it is said how many.
    #[arg(long, value_name = "N", default_value_t = 4096)]
    pub limit: usize,
    /// Print one JSON document.
    #[arg(long)]
    pub json: bool,
    /// Write a protocol as one page for a browser, to be printed and filled in.
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub html: Option<PathBuf>,
    /// Write a table (CSV) with one row for each test.
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub csv: Option<PathBuf>,
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
}

/// `petril sif excluded`
#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Example:
  petril sif excluded examples/beam-interlock.sif")]
pub struct SifExcluded {
    /// The specification. Several files are read as one.
    #[arg(value_name = "SPEC", required = true)]
    pub specification: Vec<PathBuf>,
    /// A function to look at, if not all. May be given several times.
    #[arg(short, long, value_name = "NAME")]
    pub function: Vec<String>,
    /// List at most so many valuations of a function; if there are more, cubes stand for them.
    #[arg(long, value_name = "N", default_value_t = 4096)]
    pub limit: usize,
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
}

/// Criterion by name.
fn criterion(name: &str) -> Result<Criterion, String> {
    let found = Criterion::ALL.into_iter().find(|criterion| criterion.name().eq_ignore_ascii_case(name));
    found.ok_or_else(|| format!("there are {}", Criterion::ALL.map(Criterion::name).join(", ")))
}

/// `petril sif import`
///
/// The first row with a column `name` (or `signal`, `tag`, `symbol`) is the head. Others are `direction` (or `I/O`: input, in, DI,
/// output, out, DO), `description`, `address` (`%IX0.0`, or a variable), `zone`, `function`, and `normal` (the value at rest). What is
/// written is a specification without formulas; `petril sif check` says which are missing.
#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Example:
  petril sif import io-list.xlsx -o zone.sif
  petril sif check zone.sif")]
pub struct SifImport {
    /// The list: a workbook (.xlsx), of which the first sheet is read, or text with commas, semicolons or tabs.
    #[arg(value_name = "LIST")]
    pub list: PathBuf,
    /// Where to write; standard output if not given.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Limits of the work.
    #[command(flatten)]
    pub bounds: Bounds,
}
