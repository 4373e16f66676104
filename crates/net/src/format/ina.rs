//! The Integrated Net Analyzer's format (`.pnt`; S. Roch, P. Starke, *INA: Integrated Net Analyzer*).
//!
//! ```
//! use petril_base::source::Source;
//! use petril_net::format::{ina, tina};
//!
//! let text = "tr switch {S1: the left one}*2 power?1 -> on\npl {S1: the left one} (2)\n";
//! let lamp = tina::read(&Source::new("lamp.net", text)).expect("well written");
//! assert_eq!(
//!     ina::write(&lamp.net),
//!     "P   M   PRE,POST  NETZ 0:lamp
//!   0 2 , 0:2
//!   1 0 0, 0
//!   2 0 0
//! @
//! place nr.             name capacity time
//!        0: S1__the_left_one       oo    0
//!        1: power                  oo    0
//!        2: on                     oo    0
//! @
//! trans nr.             name priority time
//!        0: switch                  0    0
//! @
//! names in full
//! place 0: S1: the left one
//! "
//! );
//! ```

use std::collections::HashSet;
use std::fmt::Write as _;
use std::io;

use super::escape::{Alphabet, escaped};
use crate::net::{Net, PlaceId, TransitionId};
use petril_base::Rows;
use petril_base::printable::is_printable;
use petril_base::to_text;

/// Length limit of names.
const LONGEST: usize = 16;

/// Names in full, which INA does not read: any text on one line.
const LINE: Alphabet = Alphabet { allows: is_printable, begins: is_printable, is_reserved: |_| false };

/// Writes a net; a read arc becomes a loop. A name that is too long or has forbidden characters is shortened to a
/// unique one; such names follow in full after the net, where INA does not look.
///
/// # Errors
/// Errors of the output.
pub fn write_to(net: &Net, out: &mut dyn io::Write) -> io::Result<()> {
    let by_place =
        |transition: TransitionId| move |(place, weight): (PlaceId, u64)| (place.index(), (transition.index(), weight));
    let count = net.places().len();
    let pre = Rows::group(count, net.transition_ids().flat_map(|id| net.post(id).map(by_place(id))));
    let post = Rows::group(count, net.transition_ids().flat_map(|id| net.pre(id).map(by_place(id))));
    writeln!(out, "P   M   PRE,POST  NETZ 0:{}", plain(net.name()))?;
    for (i, place) in net.places().enumerate() {
        write!(out, "{i:>3} {}", place.tokens)?;
        arcs(out, &pre[i])?;
        if !post[i].is_empty() {
            write!(out, "{}", if pre[i].is_empty() { " ," } else { "," })?;
            arcs(out, &post[i])?;
        }
        writeln!(out)?;
    }
    let places = short_names(net.places().map(|place| place.name));
    let transitions = short_names(net.transitions().map(|transition| transition.name));
    writeln!(out, "@\nplace nr.             name capacity time")?;
    for (i, name) in places.iter().enumerate() {
        writeln!(out, "{i:>8}: {name:<LONGEST$}       oo    0")?;
    }
    writeln!(out, "@\ntrans nr.             name priority time")?;
    for (i, name) in transitions.iter().enumerate() {
        writeln!(out, "{i:>8}: {name:<LONGEST$}        0    0")?;
    }
    writeln!(out, "@\nnames in full")?;
    let nodes = net.places().map(|place| ("place", place.name)).zip(&places).enumerate();
    let nodes =
        nodes.chain(net.transitions().map(|transition| ("trans", transition.name)).zip(&transitions).enumerate());
    for (i, ((kind, name), short)) in nodes {
        if name != short {
            writeln!(out, "{kind} {i}: {}", escaped(name, LINE))?;
        }
    }
    Ok(())
}

/// As [`write_to`], to a string.
#[must_use]
pub fn write(net: &Net) -> String {
    to_text(|out| write_to(net, out))
}

fn arcs(out: &mut dyn io::Write, arcs: &[(usize, u64)]) -> io::Result<()> {
    for &(transition, weight) in arcs {
        match weight {
            1 => write!(out, " {transition}")?,
            _ => write!(out, " {transition}:{weight}")?,
        }
    }
    Ok(())
}

/// A name with INA's characters, of any length.
fn plain(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_graphic() && !":,@".contains(c) { c } else { '_' };
    name.chars().map(plain).collect()
}

/// Unique short names of nodes.
fn short_names<'n>(names: impl Iterator<Item = &'n str>) -> Vec<String> {
    let mut taken = HashSet::new();
    let mut count = 1_u64;
    let short = |name: &str| {
        let plain = plain(name);
        let mut short: String = plain.chars().take(LONGEST).collect();
        while short.is_empty() || !taken.insert(short.clone()) {
            let mut number = String::new();
            let _ = write!(number, "~{count}");
            count += 1;
            short = plain.chars().take(LONGEST - number.len()).collect();
            short += &number;
        }
        short
    };
    names.map(short).collect()
}
