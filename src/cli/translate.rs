//! `petril translate`: export of the net of a program and its plant.

use petril::draw::{self, positions};
use petril::exchange::notes;
use petril::exchange::pnml::Extras;

use super::args::Translate;
use super::console::Console;
use super::format::Format;
use super::{Failure, Outcome, input, net_convert, output, phase, shown};

/// Maximum number of nodes drawn of a program; the file has about 100 MB then.
const MAX_DRAWN: usize = 100_000;

pub fn run(arguments: &Translate, console: &Console) -> Outcome {
    let format = Format::of(&arguments.output)?;
    let (system, source) = input::system(&arguments.program, &arguments.plant, &arguments.reading, console)?;
    let (places, transitions) = (system.net.places().len(), system.net.transitions().len());
    match format {
        Format::Svg if places + transitions > MAX_DRAWN => {
            let message = format!("a picture of {} nodes would show nothing; ", places + transitions);
            return Err(Failure::Message(message + "`petril draw --line N` draws one line of the program"));
        }
        Format::Svg => {
            phase::begin("drawing the net");
            output::write_text(&arguments.output, &draw::diagram(&system).svg())?;
        }
        Format::Pnml => {
            phase::begin("placing the nodes of the net");
            let (positions, notes, units) = (positions(&system), notes(&system, &source), system.units());
            let extras =
                Extras { positions: Some(&positions), notes: Some(&notes), units: Some(&units), ..Extras::default() };
            net_convert::write(&arguments.output, format, &system.net, extras, console)?;
        }
        _ => {
            let units = system.units();
            let extras = Extras { units: Some(&units), ..Extras::default() };
            net_convert::write(&arguments.output, format, &system.net, extras, console)?;
        }
    }
    console.print(&format!("{}: {places} places, {transitions} transitions\n", shown(&arguments.output)))
}
