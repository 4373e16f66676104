//! Command line: the only code that opens files, prints, or reads the clock. One file for each verb.
//!
//! Exit codes are a contract: 0 everything holds, 1 something is violated, 2 bad usage or input, 3 undecided.

mod args;
mod bounds;
mod cache;
mod cache_key;
mod check;
mod completions;
mod console;
mod draw;
mod explain;
mod flat;
mod format;
mod forms;
mod guard;
mod init;
mod input;
mod input_table;
mod interactive;
mod manual;
mod meaning;
mod memory;
mod net_check;
mod net_convert;
mod net_explore;
mod net_info;
mod net_reduce;
mod net_run;
mod net_structure;
mod origin;
mod output;
mod phase;
mod progress;
mod project;
mod report;
mod requirements;
mod seen;
mod show;
mod sif;
mod sign_of_life;
mod simulate;
mod translate;
mod watch;

use std::ffi::OsString;
use std::io;
use std::path::Path;
use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches};
use petril::printable;
use serde_json::json;

use args::{Args, NetVerb, Verb};
use console::Console;

/// Failure without a verdict.
pub enum Failure {
    /// Diagnostics have been printed.
    Reported,
    /// Message still to be printed.
    Message(String),
    /// The work on a program was given up at a limit, so its verdict is unknown. This has still to be said.
    Stopped(String),
}

/// Result of a verb.
pub type Outcome = Result<ExitCode, Failure>;

/// Exit code when everything holds, or the verb did its work.
pub const SUCCESS: ExitCode = ExitCode::SUCCESS;

/// Reason of an I/O error, without the system's error number and without temporary paths.
fn reason(error: &io::Error) -> String {
    let mut innermost: &dyn std::error::Error = error;
    while let Some(source) = innermost.source() {
        innermost = source;
    }
    let text = innermost.to_string();
    text.split(" (os error ").next().unwrap_or_default().to_lowercase()
}

/// A path in printable form.
fn shown(path: &Path) -> String {
    printable::line(&path.display().to_string())
}

/// Reports a command-line error, or help that was requested. The words are made printable and parsed again, so that the
/// message contains no raw input.
fn refuse(error: clap::Error, words: &[OsString]) -> ! {
    let words = words.iter().map(|word| printable::line(&word.to_string_lossy()));
    Args::command().try_get_matches_from(words).err().unwrap_or(error).exit()
}

/// Parses the command line and runs the verb.
pub fn run() -> ExitCode {
    let words: Vec<OsString> = std::env::args_os().collect();
    let matches = Args::command().try_get_matches_from(&words).unwrap_or_else(|error| refuse(error, &words));
    let args = Args::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
    let console = Console::new(args.colour);
    let wants_json = args.verb.wants_json();
    if let Some(bounds) = args.verb.bounds() {
        let (has_verdict, origin) = (args.verb.has_verdict(), console.origin());
        guard::start(&bounds, guard::Ending { has_verdict, wants_json, origin });
        sign_of_life::begin();
    }
    console.has_options(&args.verb);
    let outcome = match args.verb {
        Verb::Check(arguments) => check::run(&arguments, &project::given(&matches), &console),
        Verb::Translate(arguments) => translate::run(&arguments, &console),
        Verb::Flat(arguments) => flat::run(&arguments, &console),
        Verb::Simulate(arguments) => simulate::run(&arguments, &console),
        Verb::Draw(arguments) => draw::run(&arguments, &console),
        Verb::Net(NetVerb::Info(arguments)) => net_info::run(&arguments, &console),
        Verb::Net(NetVerb::Check(arguments)) => net_check::run(&arguments, &console),
        Verb::Net(NetVerb::Convert(arguments)) => net_convert::run(&arguments, &console),
        Verb::Net(NetVerb::Explore(arguments)) => net_explore::run(&arguments, &console),
        Verb::Net(NetVerb::Reduce(arguments)) => net_reduce::run(&arguments, &console),
        Verb::Sif(verb) => sif::run(&verb, &console),
        Verb::Explain(arguments) => explain::run(&arguments, &console),
        Verb::Init(arguments) => init::run(&arguments, &console),
        Verb::Completions(arguments) => completions::run(&arguments, &console),
        Verb::Man(arguments) => manual::run(&arguments, &console),
    };
    match outcome {
        Ok(code) => code,
        Err(failure) => {
            let mut document = json!({ "verdict": "error", "error": null });
            let mut code = ExitCode::from(2);
            match failure {
                Failure::Message(message) => {
                    console.error(&message);
                    document["error"] = message.into();
                }
                Failure::Stopped(message) => {
                    console.message(&format!("unknown: {message}\n"));
                    document = json!({ "verdict": "unknown", "error": message });
                    code = ExitCode::from(3);
                }
                Failure::Reported => {}
            }
            if wants_json {
                let _ = console.print_json(document);
            }
            code
        }
    }
}
