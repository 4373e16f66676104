//! The bits of all variables while a scan is compiled, as control has them that goes on; and as control had them that has jumped to
//! a line further on. What the latter had follows from the changes made since, so a jump costs nothing, and where parts of control
//! meet only bits are looked at that have changed.

use std::collections::BTreeMap;

use super::gates::{Network, Wire};

/// Control that has jumped.
pub(super) struct Jumped {
    /// When control comes by this way.
    pub(super) active: Wire,
    pub(super) result: Vec<Wire>,
    /// How many changes had been made.
    pub(super) since: usize,
}

/// The bits, and the changes that led to them.
pub(super) struct Memory {
    bits: Vec<Wire>,
    /// Each change: the bit, and what it was before.
    changes: Vec<(usize, Wire)>,
    /// For each bit, the look in which it was last seen.
    seen: Vec<usize>,
    looks: usize,
}

impl Memory {
    pub(super) fn new(bits: Vec<Wire>) -> Self {
        Self { seen: vec![0; bits.len()], bits, changes: Vec::new(), looks: 0 }
    }

    pub(super) fn bits(&self) -> &[Wire] {
        &self.bits
    }

    /// How many changes were made.
    pub(super) fn changes(&self) -> usize {
        self.changes.len()
    }

    /// Gives some bits, from `first` on, what they are now.
    pub(super) fn set(&mut self, first: usize, wires: &[Wire]) {
        for (at, &wire) in (first..).zip(wires) {
            let before = std::mem::replace(&mut self.bits[at], wire);
            if before != wire {
                self.changes.push((at, before));
            }
        }
    }

    /// The bits that were changed after so many changes, each with what it was then.
    fn since(&mut self, changes: usize) -> Vec<(usize, Wire)> {
        self.looks += 1;
        let (seen, look) = (&mut self.seen, self.looks);
        // The first change of a bit says what it was.
        let first = |(at, _): &(usize, Wire)| std::mem::replace(&mut seen[*at], look) != look;
        self.changes[changes..].iter().copied().filter(first).collect()
    }

    /// Makes the bits what they were.
    pub(super) fn return_to(&mut self, jumped: &Jumped) {
        for (at, then) in self.since(jumped.since) {
            self.set(at, &[then]);
        }
    }

    /// Makes the bits those of control that comes here by several ways: what they are now, or, where control has jumped, what they
    /// were then.
    pub(super) fn join(&mut self, network: &mut Network, jumped: &[Jumped]) {
        // For each bit what it was, and when control comes with that. Ways with the same value take one choice.
        let mut values: BTreeMap<usize, Vec<(Wire, Wire)>> = BTreeMap::new();
        for jumped in jumped {
            for (at, then) in self.since(jumped.since) {
                let values = values.entry(at).or_default();
                match values.last_mut().filter(|(value, _)| *value == then) {
                    Some((_, active)) => *active = network.or(*active, jumped.active),
                    None => values.push((then, jumped.active)),
                }
            }
        }
        for (at, values) in values {
            let now = self.bits[at];
            let chosen = values.into_iter().fold(now, |no, (yes, active)| network.choose(active, yes, no));
            self.set(at, &[chosen]);
        }
    }
}
