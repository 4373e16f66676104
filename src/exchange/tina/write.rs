//! Net to text.

use std::fmt::Write as _;

use crate::net::{Net, PlaceId};

/// Writes a net. Reading it back gives the same net.
#[must_use]
pub fn write(net: &Net) -> String {
    let mut out = format!("net {}\n", name(net.name()));
    for place in net.places() {
        let marking = if place.tokens > 0 { format!(" ({})", place.tokens) } else { String::new() };
        let _ = writeln!(out, "pl {}{marking}", name(place.name));
    }
    for id in net.transition_ids() {
        let arc = |place: PlaceId, weight: u64| match weight {
            1 => format!(" {}", name(net.place(place).name)),
            _ => format!(" {}*{weight}", name(net.place(place).name)),
        };
        let read = |place: PlaceId| net.read(id).find(|&(other, _)| other == place).map_or(0, |(_, weight)| weight);
        let _ = write!(out, "tr {}", name(net.transition(id).name));
        // A test asks for tokens that are there, perhaps the ones that are taken: what is needed besides is taken and put back.
        let both = |place: &PlaceId| net.arcs(id).consume.binary_search(place).is_ok();
        net.taken(id).for_each(|(place, weight)| out += &arc(place, weight + read(place)));
        for (place, weight) in net.read(id).filter(|(place, _)| !both(place)) {
            let _ = write!(out, " {}?{weight}", name(net.place(place).name));
        }
        out += " ->";
        net.put(id).for_each(|(place, weight)| out += &arc(place, weight));
        net.read(id).filter(|(place, _)| both(place)).for_each(|(place, weight)| out += &arc(place, weight));
        out += "\n";
    }
    out
}

/// A name as it is written: bare if it can be, else in braces.
fn name(name: &str) -> String {
    let is_bare = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '\'');
    if is_bare {
        return name.to_owned();
    }
    let escaped = name.chars().flat_map(|c| matches!(c, '{' | '}' | '\\').then_some('\\').into_iter().chain([c]));
    format!("{{{}}}", escaped.collect::<String>())
}
