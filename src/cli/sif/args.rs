//! The arguments of `petril sif`.

use std::path::PathBuf;

use clap::Subcommand;

/// The verbs on safety functions.
#[derive(Debug, Subcommand)]
pub enum SifVerb {
    /// Check that a specification makes sense: restrictions, unused inputs, functions that never change.
    Check(SifCheck),
}

impl SifVerb {
    /// Whether the answer is to be one JSON document.
    pub fn wants_json(&self) -> bool {
        match self {
            Self::Check(arguments) => arguments.json,
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
