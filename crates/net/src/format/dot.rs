//! Graphviz DOT: a net for `dot -Tsvg` and its relatives.

use std::io;

use crate::net::Net;
use petril_base::printable;
use petril_base::to_text;

/// Writes a net: places as circles, with their tokens, and transitions as boxes. The head of a read arc is a dot, as in
/// the seed paper's figure 2.
///
/// ```
/// use petril_base::source::Source;
/// use petril_net::format::{dot, tina};
///
/// let lamp = tina::read(&Source::new("lamp.net", "tr switch off power?1 -> on\npl off (1)\n")).expect("well written");
/// assert_eq!(
///     dot::write(&lamp.net),
///     r#"digraph "lamp" {
///   node [fontname="Helvetica", fontsize=10];
///   node [shape=circle, margin=0.02];
///   p0 [label="●\noff"];
///   p1 [label="power"];
///   p2 [label="on"];
///   node [shape=box, height=0.3];
///   t0 [label="switch"];
///   p0 -> t0;
///   p1 -> t0 [arrowhead=dot];
///   t0 -> p2;
/// }
/// "#
/// );
/// ```
///
/// # Errors
/// Errors of the output.
pub fn write_to(net: &Net, out: &mut dyn io::Write) -> io::Result<()> {
    writeln!(out, "digraph \"{}\" {{", escaped(net.name()))?;
    writeln!(out, "  node [fontname=\"Helvetica\", fontsize=10];")?;
    writeln!(out, "  node [shape=circle, margin=0.02];")?;
    for (i, place) in net.places().enumerate() {
        let token = match place.tokens {
            0 => String::new(),
            1 => "●\\n".to_owned(),
            n => format!("{n}\\n"),
        };
        writeln!(out, "  p{i} [label=\"{token}{}\"];", escaped(place.name))?;
    }
    writeln!(out, "  node [shape=box, height=0.3];")?;
    for (i, transition) in net.transitions().enumerate() {
        writeln!(out, "  t{i} [label=\"{}\"];", escaped(transition.name))?;
    }
    for (i, id) in net.transition_ids().enumerate() {
        let weight = |weight: u64| if weight > 1 { format!(" [label={weight}]") } else { String::new() };
        for (place, n) in net.taken(id) {
            writeln!(out, "  p{} -> t{i}{};", place.index(), weight(n))?;
        }
        for (place, n) in net.read(id) {
            let weight = if n > 1 { format!(", label={n}") } else { String::new() };
            writeln!(out, "  p{} -> t{i} [arrowhead=dot{weight}];", place.index())?;
        }
        for (place, n) in net.put(id) {
            writeln!(out, "  t{i} -> p{}{};", place.index(), weight(n))?;
        }
    }
    writeln!(out, "}}")
}

/// As [`write_to`], to a string.
#[must_use]
pub fn write(net: &Net) -> String {
    to_text(|out| write_to(net, out))
}

/// Escapes a text for a quoted DOT string, on one line. A backslash would begin a DOT escape, an ampersand an HTML
/// entity.
fn escaped(text: &str) -> String {
    let replace = |c: char| match c {
        '\\' => "\\\\".to_owned(),
        '"' => "\\\"".to_owned(),
        '&' => "&amp;".to_owned(),
        c => c.to_string(),
    };
    printable::line(text).chars().map(replace).collect()
}
