//! Subnet of a line: between its control place and those that can follow.

use std::collections::BTreeMap;

use smallvec::{SmallVec, smallvec};

use super::provenance::{PlaceRole, Register, TransitionRole};
use super::weaver::{Bit, Change, Changes, Weaver};
use petril_lang::flat::Hazard;
use petril_lang::semantics::VarId;
use petril_net::net::{Arcs, PlaceId};

/// Alternatives of a step: each moves control on if its bits have their old values.
pub type Step = Vec<Changes>;

/// Subnet of a line under construction.
pub struct Subnet<'a> {
    weaver: &'a mut Weaver,
    /// Line, from 0.
    line: usize,
    /// Control places of all lines, that of `End` the last.
    lines: &'a [PlaceId],
    /// Number of control places within the line.
    within: u32,
    hazards: BTreeMap<Hazard, PlaceId>,
    /// Name of the node under construction; kept to reuse its memory.
    name: String,
}

impl<'a> Subnet<'a> {
    pub fn new(weaver: &'a mut Weaver, line: usize, lines: &'a [PlaceId]) -> Self {
        Self { weaver, line, lines, within: 0, hazards: BTreeMap::new(), name: String::new() }
    }

    /// Control place of the line, where control enters.
    pub fn here(&self) -> PlaceId {
        self.lines[self.line]
    }

    /// Control place of the next line, where control leaves.
    pub fn next(&self) -> PlaceId {
        self.lines[self.line + 1]
    }

    /// Control place of a line.
    pub fn at_line(&self, line: usize) -> PlaceId {
        self.lines[line]
    }

    /// Adds a control place within the line.
    pub fn within(&mut self) -> PlaceId {
        self.within += 1;
        let name = format!("{}.{}", self.weaver.place_name(self.here()), self.within);
        self.weaver.place(&name, false, PlaceRole::Within(self.line, self.within))
    }

    /// Control place that a hazard in this line leads to, added on first use.
    pub fn hazard(&mut self, hazard: Hazard) -> PlaceId {
        if let Some(&known) = self.hazards.get(&hazard) {
            return known;
        }
        let name = format!("{}.{hazard}", self.weaver.place_name(self.here()));
        let place = self.weaver.place(&name, false, PlaceRole::Hazard(self.line, hazard));
        self.hazards.insert(hazard, place);
        place
    }

    /// Place of a hazard, if one of the steps leads there.
    pub fn met(&self, hazard: Hazard) -> Option<PlaceId> {
        self.hazards.get(&hazard).copied()
    }

    /// Lets control go on from the place of a hazard to `to`, if there is such a place.
    pub fn after_hazard(&mut self, hazard: Hazard, to: PlaceId) {
        if let Some(place) = self.met(hazard) {
            self.step(place, to, &[]);
        }
    }

    /// Lowest `width` bits of the current result.
    pub fn result(&self, width: u32) -> Vec<Bit> {
        self.weaver.result()[..width as usize].to_vec()
    }

    /// Lowest bit of the current result: the whole of a `BOOL`.
    pub fn truth(&self) -> Bit {
        self.weaver.result()[0]
    }

    /// Stored bits of a variable, from the lowest.
    pub fn variable(&self, variable: VarId) -> &[Bit] {
        self.weaver.variable(variable)
    }

    /// Lowest `width` bits of an auxiliary register.
    pub fn register(&mut self, register: Register, width: u32) -> Vec<Bit> {
        (0..width).map(|bit| self.weaver.register(register, bit)).collect()
    }

    /// Auxiliary register of a single bit.
    pub fn mark(&mut self) -> Bit {
        self.weaver.register(Register::Mark, 0)
    }

    /// Adds a transition between two control places, enabled by the old values of the bits, which get the new ones. No
    /// bit may be named twice.
    pub fn step(&mut self, from: PlaceId, to: PlaceId, changes: &[Change]) {
        // A bit that keeps its value gives and gets the same token: a loop, which the builder makes a read arc.
        let mut consume: SmallVec<[PlaceId; 8]> = smallvec![from];
        let mut produce: SmallVec<[PlaceId; 8]> = smallvec![to];
        self.name.clear();
        self.name.push_str(self.weaver.place_name(from));
        for (i, &(bit, before, after)) in changes.iter().enumerate() {
            consume.push(bit.place(before));
            produce.push(bit.place(after));
            self.name.push(if i == 0 { '[' } else { ',' });
            self.name.push_str(self.weaver.place_name(bit.place(before)));
        }
        self.name.push_str(if changes.is_empty() { "[]" } else { "]" });
        let arcs = Arcs { consume: &consume, produce: &produce, read: &[] };
        self.weaver.transition(&self.name, arcs, TransitionRole::Line(self.line));
    }

    /// Adds steps one after another; for no steps, one transition that changes nothing.
    pub fn chain(&mut self, from: PlaceId, to: PlaceId, steps: &[Step]) {
        if steps.is_empty() {
            self.step(from, to, &[]);
        }
        let mut at = from;
        for (i, alternatives) in steps.iter().enumerate() {
            let next = if i + 1 == steps.len() { to } else { self.within() };
            for changes in alternatives {
                self.step(at, next, changes);
            }
            at = next;
        }
    }
}
