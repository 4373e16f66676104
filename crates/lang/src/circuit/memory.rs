//! Symbolic memory while a scan is compiled: the bits of all variables at the current point of control, and a log of changes. A jump
//! records only its position in the log, from which its own memory follows; so a jump costs nothing, and a join looks only at bits
//! that have changed.

use std::collections::BTreeMap;

use super::gates::{Network, Wire};

/// Branch of control that has jumped to a line further on.
pub(super) struct Jumped {
    /// Condition under which the jump is taken.
    pub(super) active: Wire,
    pub(super) result: Vec<Wire>,
    /// Length of the log at the jump.
    pub(super) since: usize,
}

/// Bits with the log of their changes.
pub(super) struct Memory {
    bits: Vec<Wire>,
    /// Log of changes: the bit, and its wire before.
    changes: Vec<(usize, Wire)>,
    /// For each bit, the number of the last look at the log that met it.
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

    /// Length of the log.
    pub(super) fn changes(&self) -> usize {
        self.changes.len()
    }

    /// Sets the bits from `first` on.
    pub(super) fn set(&mut self, first: usize, wires: &[Wire]) {
        for (at, &wire) in (first..).zip(wires) {
            let before = std::mem::replace(&mut self.bits[at], wire);
            if before != wire {
                self.changes.push((at, before));
            }
        }
    }

    /// Bits changed since a position in the log, each with its wire there.
    fn since(&mut self, changes: usize) -> Vec<(usize, Wire)> {
        self.looks += 1;
        let (seen, look) = (&mut self.seen, self.looks);
        // The first change of a bit holds its wire from before.
        let first = |(at, _): &(usize, Wire)| std::mem::replace(&mut seen[*at], look) != look;
        self.changes[changes..].iter().copied().filter(first).collect()
    }

    /// Restores the memory of a jump.
    pub(super) fn return_to(&mut self, jumped: &Jumped) {
        for (at, then) in self.since(jumped.since) {
            self.set(at, &[then]);
        }
    }

    /// Joins the current memory with those of jumps, by multiplexers on the conditions of the jumps.
    pub(super) fn join(&mut self, network: &mut Network, jumped: &[Jumped]) {
        // For each bit its wires at the jumps, with the conditions; equal wires one after another share a multiplexer.
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
