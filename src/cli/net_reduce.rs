//! `petril net reduce`: writes a smaller net that answers the same question.

use std::fmt::Write as _;

use petril::diagnostic::nearest;
use petril::exchange::pnml::Extras;
use petril::net::{Net, PlaceId, TransitionId};
use petril::printable;
use petril::structure::reduce::{Keep, Property, Size, reduce};
use serde_json::json;

use super::args::{Kept, NetReduce};
use super::console::Console;
use super::{Failure, Outcome, input, net_convert, phase};

pub fn run(arguments: &NetReduce, console: &Console) -> Outcome {
    let format = net_convert::format(&arguments.output)?;
    let (located, _) = input::net(&arguments.model, console)?;
    let net = located.net;
    let property = match arguments.property {
        Kept::Reachability => Property::Reachability,
        Kept::Deadlock => Property::Deadlock,
        Kept::Paths => Property::Paths,
    };
    phase::begin("reducing the net");
    let reduced =
        reduce(&net, &Keep { property, places: places(&net, arguments)?, transitions: transitions(&net, arguments)? });
    net_convert::write(&arguments.output, format, &reduced.net, Extras::default(), console)?;
    let (before, after) = (Size::of(&net), Size::of(&reduced.net));
    if arguments.json {
        let size = |size: Size| json!({ "places": size.places, "transitions": size.transitions, "arcs": size.arcs });
        let applied = reduced.applied.iter().map(|(rule, times)| (rule.name().to_owned(), (*times).into()));
        return console.print_json(json!({
            "net": net.name(),
            "before": size(before),
            "after": size(after),
            "applied": applied.collect::<serde_json::Map<String, serde_json::Value>>(),
        }));
    }
    let mut out = String::new();
    for (what, before, after) in [
        ("places", before.places, after.places),
        ("transitions", before.transitions, after.transitions),
        ("arcs", before.arcs, after.arcs),
    ] {
        let _ = writeln!(out, "{what:<36}{before:>8} -> {after}");
    }
    for (rule, times) in &reduced.applied {
        let _ = writeln!(out, "  {:<34}{times:>8}", rule.name());
    }
    console.print_report(&out, &console.provenance(), false)
}

fn places(net: &Net, arguments: &NetReduce) -> Result<Vec<PlaceId>, Failure> {
    let unknown = |name: &str| unknown("place", name, net.places().map(|place| place.name));
    arguments.keep.iter().map(|name| net.find_place(name).ok_or_else(|| unknown(name))).collect()
}

fn transitions(net: &Net, arguments: &NetReduce) -> Result<Vec<TransitionId>, Failure> {
    let unknown = |name: &str| unknown("transition", name, net.transitions().map(|transition| transition.name));
    arguments.keep_enabled.iter().map(|name| net.find_transition(name).ok_or_else(|| unknown(name))).collect()
}

fn unknown<'n>(kind: &str, name: &str, names: impl Iterator<Item = &'n str>) -> Failure {
    let help = nearest(name, names).map(|nearest| format!("; did you mean `{nearest}`?")).unwrap_or_default();
    Failure::Message(printable::line(&format!("the net has no {kind} `{name}`{help}")))
}
