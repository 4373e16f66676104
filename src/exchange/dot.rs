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
        let token = match place.tokens {
            0 => String::new(),
            1 => "●\\n".to_owned(),
            n => format!("{n}\\n"),
        };
        let _ = writeln!(out, "  p{i} [label=\"{token}{}\"];", escaped(place.name));
    }
    out += "  node [shape=box, height=0.3];\n";
    for (i, transition) in net.transitions().enumerate() {
        let _ = writeln!(out, "  t{i} [label=\"{}\"];", escaped(transition.name));
    }
    for (i, id) in net.transition_ids().enumerate() {
        let mut arc = |from: String, to: String, attributes: &[String]| {
            let list = if attributes.is_empty() { String::new() } else { format!(" [{}]", attributes.join(", ")) };
            let _ = writeln!(out, "  {from} -> {to}{list};");
        };
        let weight = |weight: u64| (weight > 1).then(|| format!("label={weight}"));
        for (place, n) in net.taken(id) {
            arc(format!("p{}", place.index()), format!("t{i}"), weight(n).as_slice());
        }
        for (place, n) in net.read(id) {
            let attributes: Vec<String> = ["arrowhead=dot".to_owned()].into_iter().chain(weight(n)).collect();
            arc(format!("p{}", place.index()), format!("t{i}"), &attributes);
        }
        for (place, n) in net.put(id) {
            arc(format!("t{i}"), format!("p{}", place.index()), weight(n).as_slice());
        }
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
