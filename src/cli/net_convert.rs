//! `petril net convert`: writes a net in another format.

use std::path::Path;

use petril::exchange::pnml::{self, Extras};
use petril::exchange::{andl, dot, ina, lola, tina};
use petril::net::Net;

use super::args::NetConvert;
use super::console::Console;
use super::format::Format;
use super::{Failure, Outcome, input, output, phase, shown};

/// Upper bound on the nodes that Graphviz lays out in about a minute.
const MANY_FOR_GRAPHVIZ: usize = 2_000;

pub fn run(arguments: &NetConvert, console: &Console) -> Outcome {
    let format = format(&arguments.output)?;
    let (located, source) = input::net(&arguments.model, console)?;
    // The text may be large and is not needed any more.
    drop(source);
    let net = &located.net;
    let extras = Extras { ids: located.ids.as_ref(), units: located.units.as_ref(), ..Extras::default() };
    write(&arguments.output, format, net, extras, console)?;
    let (places, transitions) = (net.places().len(), net.transitions().len());
    console.print(&format!("{}: {places} places, {transitions} transitions\n", shown(&arguments.output)))
}

/// Format of a file, by its extension.
pub fn format(path: &Path) -> Result<Format, Failure> {
    let format = Format::of(path)?;
    if format == Format::Svg {
        let message = "an SVG picture is drawn of a program, by `petril translate`; of a net, write .dot, and let Graphviz \
                       draw it: `dot -Tsvg`";
        return Err(Failure::Message(message.to_owned()));
    }
    Ok(format)
}

/// Writes a net; only PNML supports all extras.
pub fn write(path: &Path, format: Format, net: &Net, extras: Extras<'_>, console: &Console) -> Result<(), Failure> {
    let nodes = net.places().len() + net.transitions().len();
    match format {
        Format::Lola if net.places().len() == 0 || net.transitions().len() == 0 => {
            return Err(Failure::Message("LoLA's format has no nets without places or without transitions".to_owned()));
        }
        Format::Dot if nodes > MANY_FOR_GRAPHVIZ => {
            console.message(&format!("note: Graphviz takes long for {nodes} nodes; `sfdp` takes less than `dot`\n"));
        }
        _ => {}
    }
    phase::begin("writing the net");
    let is_safe = extras.units.is_some_and(|units| units.safe);
    output::write(path, &|out| match format {
        Format::Pnml => pnml::write_to(net, extras, out),
        Format::Tina => tina::write_to(net, out),
        Format::Lola => lola::write_to(net, is_safe, out),
        Format::Andl => andl::write_to(net, out),
        Format::Ina => ina::write_to(net, out),
        Format::Dot | Format::Svg => dot::write_to(net, out),
    })
}
