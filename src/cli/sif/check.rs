//! `petril sif check`: what a specification says, and whether it makes sense.

use super::args::SifCheck;
use super::specification;
use crate::cli::console::Console;
use crate::cli::{Outcome, report::counted};

pub fn run(arguments: &SifCheck, console: &Console) -> Outcome {
    let read = specification(&arguments.specification, console)?;
    let specification = &read.specification;
    let functions = counted(specification.functions.len(), "function");
    console.print(&format!("{functions}, {}\n", counted(specification.inputs().count(), "input")))
}
