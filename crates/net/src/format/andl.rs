//! ANDL, the abstract net description language of Snoopy, MARCIE and Charlie (`.andl`; M. Schwarick, C. Rohr, M. Heiner,
//! *MARCIE Manual*, 2016).
//!
//! ```
//! use petril_base::source::Source;
//! use petril_net::format::{andl, tina};
//!
//! let lamp = tina::read(&Source::new("lamp.net", "tr on {S1=0}*2 power?1 -> on\npl {S1=0} (2)\n")).expect("well written");
//! assert_eq!(
//!     andl::write(&lamp.net),
//!     "pn [lamp]
//! {
//! places:
//! discrete:
//!   S1_x3D_0 = 2;
//!   power = 0;
//!   on = 0;
//! transitions:
//!   on_x_ : : [S1_x3D_0 - 2] & [power - 1] & [power + 1] & [on + 1] ;
//! }
//! "
//! );
//! ```

use std::collections::HashSet;
use std::io;

use super::escape::{APART, Alphabet, escaped};
use crate::net::Net;
use petril_base::to_text;

/// Keywords of nets, of the functions of stochastic nets, and of the tools' formulas, in lower case.
const RESERVED: [&str; 62] = [
    "abs",
    "acos",
    "all",
    "and",
    "asin",
    "atan",
    "biomassaction",
    "bool",
    "ceil",
    "colorsets",
    "colpn",
    "colspn",
    "const",
    "constants",
    "continuous",
    "cos",
    "cpn",
    "deadlock",
    "deterministic",
    "discrete",
    "double",
    "else",
    "exp",
    "false",
    "floor",
    "functions",
    "gspn",
    "hpn",
    "if",
    "immediate",
    "inf",
    "init",
    "int",
    "levelinterpretation",
    "ln",
    "log",
    "log10",
    "massaction",
    "max",
    "michaelismenten",
    "min",
    "mixed",
    "not",
    "observers",
    "oo",
    "or",
    "place",
    "places",
    "pn",
    "pow",
    "scheduled",
    "sin",
    "spn",
    "sqrt",
    "stochastic",
    "tan",
    "then",
    "transition",
    "transitions",
    "true",
    "valuesets",
    "xspn",
];

/// Names in ANDL. Words of one or two capital letters are reserved for temporal operators.
pub(super) const NAMES: Alphabet = Alphabet {
    allows: |c| c.is_ascii_alphanumeric() || c == '_',
    begins: |c| c.is_ascii_alphabetic(),
    is_reserved: |name| {
        let is_operator = name.len() <= 2 && name.chars().all(|c| c.is_ascii_uppercase());
        is_operator || RESERVED.binary_search(&name.to_ascii_lowercase().as_str()).is_ok()
    },
};

/// Writes a net; a read arc becomes a loop. A transition that shares its name with a place gets the suffix `_x_`: names
/// are unique among all nodes.
///
/// # Errors
/// Errors of the output.
pub fn write_to(net: &Net, out: &mut dyn io::Write) -> io::Result<()> {
    writeln!(out, "pn [{}]\n{{\nplaces:\ndiscrete:", escaped(net.name(), NAMES))?;
    let places: Vec<String> = net.places().map(|place| escaped(place.name, NAMES)).collect();
    for (place, name) in net.places().zip(&places) {
        writeln!(out, "  {name} = {};", place.tokens)?;
    }
    let taken: HashSet<&str> = places.iter().map(String::as_str).collect();
    writeln!(out, "transitions:")?;
    for id in net.transition_ids() {
        let name = escaped(net.transition(id).name, NAMES);
        let apart = if taken.contains(name.as_str()) { APART } else { "" };
        write!(out, "  {name}{apart} : :")?;
        let arcs = net.pre(id).map(|arc| (arc, '-')).chain(net.post(id).map(|arc| (arc, '+')));
        for (i, ((place, weight), sign)) in arcs.enumerate() {
            write!(out, "{} [{} {sign} {weight}]", if i > 0 { " &" } else { "" }, places[place.index()])?;
        }
        writeln!(out, " ;")?;
    }
    writeln!(out, "}}")
}

/// As [`write_to`], to a string.
#[must_use]
pub fn write(net: &Net) -> String {
    to_text(|out| write_to(net, out))
}

#[cfg(test)]
mod tests {
    #[test]
    fn reserved_words_can_be_searched() {
        assert!(super::RESERVED.is_sorted());
    }
}
