//! Traces of TAPAAL and its engine verifypn: transitions in the order of firing, each with the tokens it consumes.
//!
//! ```
//! use petril_base::source::Source;
//! use petril_net::format::{tapaal, tina};
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

/// Upper bound on the tokens of a trace: each is an element of its own.
const MAX_TOKENS: u64 = 10_000_000;

/// Error: the transitions of a trace consume too many tokens to list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooManyTokens;

/// Writes a firing sequence of a net, with these ids of places and transitions, or else their names. For a lasso,
/// `loop_start` is the number of firings before the marking that the last firing returns to.
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
