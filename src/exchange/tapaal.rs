//! The traces of TAPAAL and its engine verifypn: the transitions in the order of firing, each with the tokens it takes.
//!
//! ```
//! use petril::{exchange::{tapaal, tina}, source::Source};
//!
//! let lamp = tina::read(&Source::new("lamp.net", "tr switch off*2 power?1 -> on\n")).expect("well written");
//! let switch = lamp.net.find_transition("switch").expect("there is one");
//! assert_eq!(
//!     tapaal::trace(&lamp.net, None, &[switch], None).expect("few tokens"),
//!     r#"<trace>
//!   <transition id="switch">
//!     <token place="off" age="0"/>
//!     <token place="off" age="0"/>
//!     <token place="power" age="0"/>
//!   </transition>
//! </trace>
//! "#
//! );
//! ```

use std::fmt::Write as _;

use quick_xml::escape::escape;

use crate::net::{Net, TransitionId};
use petril_base::printable;

/// The most tokens a trace may tell of: each is an element of its own.
const MAX_TOKENS: u64 = 10_000_000;

/// The transitions of a trace take too many tokens to be told one by one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooManyTokens;

/// A firing sequence of a net whose nodes have these ids, those of places first; their names if there are none. `loop_start` is
/// the number of firings after which a run without end comes back to the same marking.
///
/// # Errors
/// [`TooManyTokens`] beyond ten million.
pub fn trace(
    net: &Net,
    ids: Option<&(Vec<String>, Vec<String>)>,
    firings: &[TransitionId],
    loop_start: Option<usize>,
) -> Result<String, TooManyTokens> {
    let tokens = firings.iter().flat_map(|&id| net.pre(id)).fold(0, |sum: u64, (_, weight)| sum.saturating_add(weight));
    if tokens > MAX_TOKENS {
        return Err(TooManyTokens);
    }
    let mut out = "<trace>\n".to_owned();
    for (i, &id) in firings.iter().enumerate() {
        if loop_start == Some(i) {
            out += "  <loop/>\n";
        }
        let name = ids.map_or(net.transition(id).name, |(_, transitions)| &transitions[id.index()]);
        let _ = writeln!(out, "  <transition id=\"{}\">", quoted(name));
        for (place, weight) in net.pre(id) {
            let name = quoted(ids.map_or(net.place(place).name, |(places, _)| &places[place.index()]));
            for _ in 0..weight {
                let _ = writeln!(out, "    <token place=\"{name}\" age=\"0\"/>");
            }
        }
        out += "  </transition>\n";
    }
    Ok(out + "</trace>\n")
}

fn quoted(name: &str) -> String {
    escape(printable::line(name)).into_owned()
}
