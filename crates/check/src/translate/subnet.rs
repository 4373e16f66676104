//! The place an instruction has in the net: between the control place of its line and those it can go on to.

use std::collections::BTreeMap;

use smallvec::{SmallVec, smallvec};

use super::provenance::{PlaceRole, Register, TransitionRole};
use super::weaver::{Bit, Change, Changes, Weaver};
use petril_lang::flat::Hazard;
use petril_lang::semantics::VarId;
use petril_net::net::{Arcs, PlaceId};

/// What can happen in one step: each alternative moves control on if its bits have their old values.
pub type Step = Vec<Changes>;

/// The subnet of one line in the making.
pub struct Subnet<'a> {
    weaver: &'a mut Weaver,
    /// The line, from 0.
    line: usize,
    /// The control places of all lines, `End` the last.
    lines: &'a [PlaceId],
    /// How many places there are within the line.
    within: u32,
    hazards: BTreeMap<Hazard, PlaceId>,
    /// The name of the node in the making; kept for its memory.
    name: String,
}

impl<'a> Subnet<'a> {
    pub fn new(weaver: &'a mut Weaver, line: usize, lines: &'a [PlaceId]) -> Self {
        Self { weaver, line, lines, within: 0, hazards: BTreeMap::new(), name: String::new() }
    }

    /// Where control enters.
    pub fn here(&self) -> PlaceId {
        self.lines[self.line]
    }

    /// Where control leaves: the line behind this one.
    pub fn next(&self) -> PlaceId {
        self.lines[self.line + 1]
    }

    /// The control place of a line.
    pub fn at_line(&self, line: usize) -> PlaceId {
        self.lines[line]
    }

    /// A new control place within the line.
    pub fn within(&mut self) -> PlaceId {
        self.within += 1;
        let name = format!("{}.{}", self.weaver.place_name(self.here()), self.within);
        self.weaver.place(&name, false, PlaceRole::Within(self.line, self.within))
    }

    /// The control place that says that a hazard has happened in this line, made when it is first asked for.
    pub fn hazard(&mut self, hazard: Hazard) -> PlaceId {
        if let Some(&known) = self.hazards.get(&hazard) {
            return known;
        }
        let name = format!("{}.{hazard}", self.weaver.place_name(self.here()));
        let place = self.weaver.place(&name, false, PlaceRole::Hazard(self.line, hazard));
        self.hazards.insert(hazard, place);
        place
    }

    /// The place of a hazard if one of the steps leads there.
    pub fn met(&self, hazard: Hazard) -> Option<PlaceId> {
        self.hazards.get(&hazard).copied()
    }

    /// Lets control go on from the place of a hazard, if there is one.
    pub fn after_hazard(&mut self, hazard: Hazard, to: PlaceId) {
        if let Some(place) = self.met(hazard) {
            self.step(place, to, &[]);
        }
    }

    /// The lowest `width` bits of the current result.
    pub fn result(&self, width: u32) -> Vec<Bit> {
        self.weaver.result()[..width as usize].to_vec()
    }

    /// The lowest bit of the current result: all of it while it is a `BOOL`.
    pub fn truth(&self) -> Bit {
        self.weaver.result()[0]
    }

    /// The stored bits of a variable.
    pub fn variable(&self, variable: VarId) -> &[Bit] {
        self.weaver.variable(variable)
    }

    /// The lowest `width` bits of an auxiliary register.
    pub fn register(&mut self, register: Register, width: u32) -> Vec<Bit> {
        (0..width).map(|bit| self.weaver.register(register, bit)).collect()
    }

    /// The auxiliary register of one bit.
    pub fn mark(&mut self) -> Bit {
        self.weaver.register(Register::Mark, 0)
    }

    /// One transition between two control places, enabled by the old values of the bits, which get the new ones. No bit may
    /// be named twice.
    pub fn step(&mut self, from: PlaceId, to: PlaceId, changes: &[Change]) {
        // A bit that keeps its value gives and gets the same token: a loop, which the builder takes for a read arc.
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

    /// Steps one after another; none is one transition that changes nothing.
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
