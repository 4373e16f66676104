//! `petril flat`: prints the numbered code of a program.

use super::args::Flat;
use super::console::Console;
use super::{Outcome, input};

pub fn run(arguments: &Flat, console: &Console) -> Outcome {
    let program = input::program(&arguments.program, &arguments.reading, console)?;
    console.print(&program.flat.listing(&program.source))
}
