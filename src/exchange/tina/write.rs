//! Net to text.

use std::fmt::Write as _;

use crate::net::{Net, PlaceId};

/// Writes a net. Reading it back gives the same net.
#[must_use]
pub fn write(net: &Net) -> String {
    let mut out = format!("net {}\n", name(net.name()));
    for place in net.places() {
        let marking = if place.marked { " (1)" } else { "" };
        let _ = writeln!(out, "pl {}{marking}", name(place.name));
    }
    for transition in net.transitions() {
        let list = |places: &[PlaceId], suffix: &str| -> String {
            places.iter().map(|&id| format!(" {}{suffix}", name(net.place(id).name))).collect()
        };
        let arcs = transition.arcs;
        let inputs = list(arcs.consume, "") + &list(arcs.read, "?1");
        let _ = writeln!(out, "tr {}{inputs} ->{}", name(transition.name), list(arcs.produce, ""));
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
