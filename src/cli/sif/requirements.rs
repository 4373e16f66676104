//! `petril sif requirements`: export of a specification as a requirement file.

use petril::sif::requirements;

use super::args::SifRequirements;
use super::specification;
use crate::cli::console::Console;
use crate::cli::{Outcome, SUCCESS, output};

pub fn run(arguments: &SifRequirements, console: &Console) -> Outcome {
    let read = specification(&arguments.specification, console)?;
    let text = requirements(&read.specification);
    match &arguments.output {
        None => console.print(&text),
        Some(path) => {
            output::write_text(path, &text)?;
            Ok(SUCCESS)
        }
    }
}
