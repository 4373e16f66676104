//! Fingerprints of systems and requirements (32 bytes): equal fingerprints mean equal meaning, so cached outcomes
//! apply.
//!
//! All fields are hashed through derived `Debug`, so that no field can be forgotten. Only source positions are left
//! out: neither comments nor layout change what a program does.

use std::fmt::{self, Write};

use blake3::Hasher;

use crate::requirement::Demand;
use crate::translate::System;
use crate::verdict::Options;
use petril_base::source::Span;

/// Fingerprint of a system under given options, in hexadecimal digits. Equal only for programs with the same flat code
/// and the same variables, plants, domains of inputs, assumptions, assertions, and limits of the search. Independent of
/// the requirements checked.
#[must_use]
pub fn fingerprint(system: &System, options: &Options) -> String {
    let Options { view, fairness, budget, tolerated, assumptions, assertions } = options;
    let mut program = system.program.clone();
    program.variables.iter_mut().for_each(|variable| variable.span = None);
    // Lines that come from one piece of source belong together: their group stays, the position goes.
    let mut first = rustc_hash::FxHashMap::default();
    for (position, line) in program.code.iter_mut().enumerate() {
        let group = *first.entry(line.span).or_insert(position);
        line.span = Span::new(group, group);
    }
    let asserted: Vec<_> = assertions.iter().map(|assertion| (&assertion.formula, &assertion.lines)).collect();
    of(&(program, &system.plant, &system.domains, (view, fairness, budget, tolerated), assumptions, asserted))
}

/// Fingerprint of a requirement, given its system.
pub(super) fn of_demand(demand: &Demand) -> String {
    of(demand)
}

fn of(meaning: &dyn fmt::Debug) -> String {
    let mut text = Text(Hasher::new());
    // Writing to a hash never fails.
    let _ = write!(text, "{meaning:?}");
    text.0.finalize().to_string()
}

/// A hasher as a `fmt::Write` sink.
struct Text(Hasher);

impl Write for Text {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text.as_bytes());
        Ok(())
    }
}
