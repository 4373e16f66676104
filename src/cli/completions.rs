//! `petril completions`: shell completions.

use clap::CommandFactory;

use super::Outcome;
use super::args::{Args, Completions};
use super::console::Console;

pub fn run(arguments: &Completions, console: &Console) -> Outcome {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Args::command(), "petril", &mut script);
    console.print(&String::from_utf8_lossy(&script))
}
