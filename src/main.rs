//! The command line of Petril.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
