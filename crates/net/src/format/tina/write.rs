//! Writer: net to TINA's format.

use std::borrow::Cow;
use std::io;

use crate::net::{Net, PlaceId};
use petril_base::to_text;

/// Keywords that begin a declaration.
pub(super) const WORDS: [&str; 6] = ["lb", "net", "nt", "pl", "pr", "tr"];

/// Writes a net. Reading the text gives the same net.
///
/// # Errors
/// Errors of the output.
pub fn write_to(net: &Net, out: &mut dyn io::Write) -> io::Result<()> {
    writeln!(out, "net {}", name(net.name()))?;
    for place in net.places() {
        write!(out, "pl {}", name(place.name))?;
        if place.tokens > 0 {
            write!(out, " ({})", place.tokens)?;
        }
        writeln!(out)?;
    }
    for id in net.transition_ids() {
        let place = |place: PlaceId| name(net.place(place).name);
        let arc = |out: &mut dyn io::Write, to: PlaceId, weight: u64| match weight {
            1 => write!(out, " {}", place(to)),
            _ => write!(out, " {}*{weight}", place(to)),
        };
        let read = |place: PlaceId| net.read(id).find(|&(other, _)| other == place).map_or(0, |(_, weight)| weight);
        // A test may be satisfied by tokens that are consumed, so tokens needed in addition are consumed and produced
        // again.
        let both = |place: PlaceId| net.arcs(id).consume.binary_search(&place).is_ok();
        write!(out, "tr {}", name(net.transition(id).name))?;
        for (place, weight) in net.taken(id) {
            arc(out, place, weight + read(place))?;
        }
        for (tested, weight) in net.read(id).filter(|&(place, _)| !both(place)) {
            write!(out, " {}?{weight}", place(tested))?;
        }
        write!(out, " ->")?;
        for (place, weight) in net.put(id).chain(net.read(id).filter(|&(place, _)| both(place))) {
            arc(out, place, weight)?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// As [`write_to`], to a string.
#[must_use]
pub fn write(net: &Net) -> String {
    to_text(|out| write_to(net, out))
}

/// Spelling of a name: bare if possible, else in braces.
fn name(name: &str) -> Cow<'_, str> {
    let is_bare = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '\'');
    if is_bare && !WORDS.contains(&name) {
        return Cow::Borrowed(name);
    }
    let escaped = name.chars().flat_map(|c| matches!(c, '{' | '}' | '\\').then_some('\\').into_iter().chain([c]));
    Cow::Owned(format!("{{{}}}", escaped.collect::<String>()))
}
