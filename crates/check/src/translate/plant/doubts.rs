//! Warnings about doubtful parts of a plant, which is accepted as it is: a name is probably mistyped.

use std::collections::BTreeSet;

use super::read::Device;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_net::net::{Located, PlaceId};

/// Warnings about the devices of a net, in the order of its text.
pub fn warnings(file: &Located, devices: &[Device]) -> Vec<Diagnostic> {
    let mut warnings: Vec<Diagnostic> = devices.iter().flat_map(|device| dead_transitions(file, device)).collect();
    warnings.extend(undeclared_sinks(file, devices));
    warnings.sort_by_key(Diagnostic::span);
    warnings
}

fn dead_transitions<'a>(file: &'a Located, device: &'a Device) -> impl Iterator<Item = Diagnostic> + 'a {
    let dead = device.component.dead_transitions().into_iter();
    dead.map(|position| {
        let transition = &device.component.transitions[position];
        let unmarked = transition.consume.iter().chain(&transition.read).find(|&&place| {
            let is_marked = |marking: &super::LocalMarking| marking.marked.binary_search(&place).is_ok();
            !device.component.markings.iter().any(is_marked)
        });
        let span = file.transition_span(device.transitions[position]);
        let message = format!("the transition `{}` can never fire", transition.name);
        let warning = Diagnostic::new(Code::PlantTransitionDead, span, message);
        match unmarked {
            Some(&place) => warning.also(file.place_span(device.places[place]), "this place is never marked").help(
                "is a name mistyped? A place that no transition marks must be marked at the beginning: `pl place (1)`",
            ),
            None => warning.help("the places it needs are never marked together, or it asks an output for two values"),
        }
    })
}

/// Warnings about undeclared places that no transition leaves: a mistyped name makes such a place, in which the device
/// stays for ever.
fn undeclared_sinks(file: &Located, devices: &[Device]) -> Vec<Diagnostic> {
    let left = file.net.transition_ids().flat_map(|id| file.net.arcs(id).consume.iter().copied());
    let left: BTreeSet<PlaceId> = left.collect();
    let own: BTreeSet<PlaceId> = devices.iter().flat_map(|device| device.places.iter().copied()).collect();
    let sinks = file.undeclared.iter().filter(|place| own.contains(place) && !left.contains(place));
    sinks
        .map(|&place| {
            let name = file.net.place(place).name;
            let message = format!("the place `{name}` is not declared, and no transition leaves it");
            Diagnostic::new(Code::PlantPlaceUndeclared, file.place_span(place), message)
                .help(format!("if its name is right, declare it: `pl {{{name}}}`"))
        })
        .collect()
}
