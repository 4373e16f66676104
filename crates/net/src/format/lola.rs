//! LoLA's format for place/transition nets (`.lola`; K. Wolf, *LoLA 2*).
//!
//! ```
//! use petril_base::source::Source;
//! use petril_net::format::{lola, tina};
//!
//! let lamp = tina::read(&Source::new("lamp.net", "tr switch {S1=0}*2 power?1 -> on\npl {S1=0} (2)\n")).expect("well written");
//! assert_eq!(
//!     lola::write(&lamp.net, false),
//!     "PLACE S1=0, power, on;
//! MARKING S1=0: 2;
//! TRANSITION switch
//! CONSUME S1=0: 2, power: 1;
//! PRODUCE power: 1, on: 1;
//! "
//! );
//! ```

use std::io;

use super::escape::{Alphabet, escaped};
use crate::net::{Net, PlaceId};
use petril_base::to_text;

/// Keywords of nets, and of formulas, which use the same names for nodes.
const RESERVED: [&str; 31] = [
    "ALLPATH",
    "ALWAYS",
    "AND",
    "CONSUME",
    "DEADLOCK",
    "EVENTUALLY",
    "EXPATH",
    "FAIR",
    "FALSE",
    "FIREABLE",
    "FORMULA",
    "IMPOSSIBLE",
    "INITIAL",
    "INVARIANT",
    "MARKING",
    "MAX",
    "NEXTSTATE",
    "NOT",
    "OR",
    "PLACE",
    "PRODUCE",
    "REACHABLE",
    "RELEASE",
    "SAFE",
    "STRONG",
    "TRANSITION",
    "TRUE",
    "UNTIL",
    "WEAK",
    "XOR",
    "oo",
];

/// Names in LoLA: no blanks and none of `, ; : ( ) { }`; no prefix of a number, operator or comment.
pub(super) const NAMES: Alphabet = Alphabet {
    allows: |c| c.is_ascii_graphic() && !",;:(){}/*\"".contains(c),
    begins: |c| c.is_ascii_alphabetic() || c == '_',
    // Operators of CTL may be written together, like `AGEF`.
    is_reserved: |name| RESERVED.contains(&name) || name.chars().all(|c| "AGEFXUR".contains(c)),
};

/// Writes a net; a read arc becomes a loop. `is_safe` states that the net is known to be safe (1-bounded), which LoLA
/// exploits.
///
/// LoLA requires at least one place and one transition.
///
/// # Errors
/// Errors of the output.
pub fn write_to(net: &Net, is_safe: bool, out: &mut dyn io::Write) -> io::Result<()> {
    let name = |place: PlaceId| escaped(net.place(place).name, NAMES);
    write!(out, "PLACE {}", if is_safe { "SAFE 1: " } else { "" })?;
    list(out, net.place_ids().map(name))?;
    write!(out, "MARKING")?;
    let marked = net.place_ids().filter(|&place| net.place(place).is_marked());
    nodes(out, marked.map(|place| (place, net.place(place).tokens)), name)?;
    for id in net.transition_ids() {
        write!(out, "TRANSITION {}\nCONSUME", escaped(net.transition(id).name, NAMES))?;
        nodes(out, net.pre(id), name)?;
        write!(out, "PRODUCE")?;
        nodes(out, net.post(id), name)?;
    }
    Ok(())
}

/// As [`write_to`], to a string.
#[must_use]
pub fn write(net: &Net, is_safe: bool) -> String {
    to_text(|out| write_to(net, is_safe, out))
}

fn nodes(
    out: &mut dyn io::Write,
    nodes: impl Iterator<Item = (PlaceId, u64)>,
    name: impl Fn(PlaceId) -> String,
) -> io::Result<()> {
    let mut nodes = nodes.map(|(place, count)| format!("{}: {count}", name(place))).peekable();
    if nodes.peek().is_some() {
        write!(out, " ")?;
    }
    list(out, nodes)
}

fn list(out: &mut dyn io::Write, items: impl Iterator<Item = String>) -> io::Result<()> {
    for (i, item) in items.enumerate() {
        write!(out, "{}{item}", if i > 0 { ", " } else { "" })?;
    }
    writeln!(out, ";")
}
