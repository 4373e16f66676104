//! The arguments of `petril sif`.

use std::path::PathBuf;

use clap::Subcommand;

/// The verbs on safety functions.
#[derive(Debug, Subcommand)]
pub enum SifVerb {
    /// Check that a specification makes sense: restrictions, unused inputs, functions that never change.
    Check(SifCheck),
    /// Write a specification as requirements, for `petril check`.
    Requirements(SifRequirements),
}

impl SifVerb {
    /// Whether the answer is to be one JSON document.
    pub fn wants_json(&self) -> bool {
        match self {
            Self::Check(arguments) => arguments.json,
            Self::Requirements(_) => false,
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
    /// Stop after this many seconds; what is open then is said.
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0)]
    pub timeout: f64,
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
