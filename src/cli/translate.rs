//! `petril translate`: the net of a program and its plant, as a file.

use std::ffi::OsStr;

use petril::draw::{self, Positions};
use petril::exchange::{Notes, dot, pnml, tina};

use super::args::Translate;
use super::console::Console;
use super::{Failure, Outcome, input, output};

pub fn run(arguments: &Translate, console: &Console) -> Outcome {
    let extension = arguments.output.extension().and_then(OsStr::to_str).unwrap_or_default();
    if !["pnml", "net", "dot", "svg"].contains(&extension) {
        let message = format!(
            "`{}` says no format: its name must end with .pnml, .net (TINA), .dot or .svg",
            arguments.output.display()
        );
        return Err(Failure::Message(message));
    }
    let (system, source) = input::system(&arguments.program, &arguments.plant, &arguments.reading, console)?;
    let text = match extension {
        "pnml" => pnml::write(&system.net, Some(&Positions::of(&system)), Some(&Notes::of(&system, &source))),
        "net" => tina::write(&system.net),
        "dot" => dot::write(&system.net),
        _ => draw::diagram(&system),
    };
    output::write(&arguments.output, &text)?;
    let (places, transitions) = (system.net.places().len(), system.net.transitions().len());
    console.print(&format!("{}: {places} places, {transitions} transitions\n", arguments.output.display()))
}
