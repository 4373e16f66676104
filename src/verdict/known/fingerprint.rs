//! What a system and a requirement mean, in 32 bytes: what is known of one is known of all that have the same.
//!
//! All fields of the data are written out as `Debug` derives it, so that no field can be forgotten. Only the places in the
//! source are left out: neither comments nor the layout of a text change what its program does.

use std::fmt::{self, Write};

use blake3::Hasher;

use crate::logic::Demand;
use crate::translate::System;
use crate::verdict::Options;
use petril_base::source::Span;

/// The fingerprint of a system that is checked in this way, in hexadecimal digits. It is the same only for programs with the same
/// flat code and the same variables, plants, domains of inputs, assumptions, assertions, and limits of the search. It does not
/// depend on which requirements are checked.
#[must_use]
pub fn fingerprint(system: &System, options: &Options) -> String {
    let Options { view, fairness, budget, tolerated, assumptions, assertions } = options;
    let mut program = system.program.clone();
    program.variables.iter_mut().for_each(|variable| variable.span = None);
    // Lines that come from one piece of source belong together, wherever it stands.
    let mut first = rustc_hash::FxHashMap::default();
    for (position, line) in program.code.iter_mut().enumerate() {
        let group = *first.entry(line.span).or_insert(position);
        line.span = Span::new(group, group);
    }
    let asserted: Vec<_> = assertions.iter().map(|assertion| (&assertion.formula, &assertion.lines)).collect();
    of(&(program, &system.plant, &system.domains, (view, fairness, budget, tolerated), assumptions, asserted))
}

/// The fingerprint of a requirement of a system.
pub(super) fn of_demand(demand: &Demand) -> String {
    of(demand)
}

fn of(meaning: &dyn fmt::Debug) -> String {
    let mut text = Text(Hasher::new());
    // A hash takes everything.
    let _ = write!(text, "{meaning:?}");
    text.0.finalize().to_string()
}

/// A hash that is written to like a text.
struct Text(Hasher);

impl Write for Text {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text.as_bytes());
        Ok(())
    }
}
