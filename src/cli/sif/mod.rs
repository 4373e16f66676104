//! `petril sif`: specification, tests and proofs of safety functions. One file per verb.

pub mod args;
mod check;
mod excluded;
mod import;
mod planned;
mod prove;
mod requirements;
mod run;
mod tests;
mod valuations;

use std::path::{Path, PathBuf};

use petril::diagnostic::any_error;
use petril::sif::{Located, Specification};
use petril::source::Source;

use super::console::Console;
use super::input::{MAX_TEXT, source};
use super::{Failure, Outcome, phase};
use args::SifVerb;

pub fn run(verb: &SifVerb, console: &Console) -> Outcome {
    match verb {
        SifVerb::Check(arguments) => check::run(arguments, console),
        SifVerb::Excluded(arguments) => excluded::run(arguments, console),
        SifVerb::Import(arguments) => import::run(arguments, console),
        SifVerb::Prove(arguments) => prove::run(arguments, console),
        SifVerb::Requirements(arguments) => requirements::run(arguments, console),
        SifVerb::Run(arguments) => run::run(arguments, console),
        SifVerb::Tests(arguments) => tests::run(arguments, console),
    }
}

/// Specification with its source texts.
struct Read {
    specification: Specification,
    sources: Vec<Source>,
}

/// Reads files as one specification. Prints their diagnostics, including warnings.
fn specification(paths: &[PathBuf], console: &Console) -> Result<Read, Failure> {
    let sources: Result<Vec<Source>, Failure> =
        paths.iter().map(|path: &PathBuf| source(Path::new(path), MAX_TEXT, console)).collect();
    let sources = sources?;
    phase::begin("reading the specification");
    let (specification, diagnostics) = Specification::read(&sources);
    for (source, diagnostics) in sources.iter().zip(&diagnostics) {
        console.diagnostics(diagnostics, source);
    }
    match specification {
        Some(specification) if !diagnostics.iter().any(|list| any_error(list)) => Ok(Read { specification, sources }),
        _ => Err(Failure::Reported),
    }
}

/// Prints the diagnostics of signals without a counterpart in the program.
fn unbound(found: &[Located], sources: &[Source], console: &Console) -> Failure {
    for (file, source) in sources.iter().enumerate() {
        let own: Vec<_> =
            found.iter().filter(|(of, _)| *of == file).map(|(_, diagnostic)| diagnostic.clone()).collect();
        console.diagnostics(&own, source);
    }
    Failure::Reported
}
