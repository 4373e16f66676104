//! Graphviz DOT: a net for `dot -Tsvg` and its relatives.

use std::fmt::Write as _;

use crate::net::Net;

/// Writes a net: places as circles, the marked ones with a token, transitions as boxes. The head of a read arc is a dot, as
/// in the seed paper's figure 2.
///
/// ```
/// use petril::{exchange::{dot, tina}, source::Source};
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
#[must_use]
pub fn write(net: &Net) -> String {
    let mut out = format!("digraph \"{}\" {{\n", escaped(net.name()));
    out += "  node [fontname=\"Helvetica\", fontsize=10];\n";
    out += "  node [shape=circle, margin=0.02];\n";
    for (i, place) in net.places().enumerate() {
        let token = if place.marked { "●\\n" } else { "" };
        let _ = writeln!(out, "  p{i} [label=\"{token}{}\"];", escaped(place.name));
    }
    out += "  node [shape=box, height=0.3];\n";
    for (i, transition) in net.transitions().enumerate() {
        let _ = writeln!(out, "  t{i} [label=\"{}\"];", escaped(transition.name));
    }
    for (i, transition) in net.transitions().enumerate() {
        let arcs = transition.arcs;
        arcs.consume.iter().for_each(|place| _ = writeln!(out, "  p{} -> t{i};", place.index()));
        arcs.read.iter().for_each(|place| _ = writeln!(out, "  p{} -> t{i} [arrowhead=dot];", place.index()));
        arcs.produce.iter().for_each(|place| _ = writeln!(out, "  t{i} -> p{};", place.index()));
    }
    out + "}\n"
}

/// A text inside the quotes of a DOT string. A backslash would begin one of its escapes, an ampersand one of HTML's, and a
/// NUL would end the file.
fn escaped(text: &str) -> String {
    let replace = |c: char| match c {
        '\\' => "\\\\".to_owned(),
        '"' => "\\\"".to_owned(),
        '&' => "&amp;".to_owned(),
        '\n' => "\\n".to_owned(),
        '\0' => char::REPLACEMENT_CHARACTER.to_string(),
        c => c.to_string(),
    };
    text.chars().map(replace).collect()
}
