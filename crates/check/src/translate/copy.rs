//! Copying of an input, bit by bit from the highest (seed paper, figure 8).

use std::collections::{BTreeMap, VecDeque};

use super::domain::Domain;
use super::provenance::{PlaceRole, TransitionRole};
use super::ranges::Block;
use super::weaver::{Bit, VALUES, Weaver};
use petril_lang::flat::FlatProgram;
use petril_lang::semantics::VarId;
use petril_net::net::{Arcs, PlaceId};

/// Control places before and after the copying of an input.
#[derive(Clone, Copy)]
pub struct Way {
    pub from: PlaceId,
    pub to: PlaceId,
}

/// Place of the plant that gives an input a value.
pub struct Source {
    pub place: PlaceId,
    pub name: String,
    /// Value of the input, as a pattern.
    pub pattern: u64,
}

struct Copying<'a> {
    weaver: &'a mut Weaver,
    program: &'a FlatProgram,
    input: VarId,
    way: Way,
    /// Number of control places added so far.
    within: u32,
}

/// Copies the value of the plant's marked place to the input.
pub fn driven(weaver: &mut Weaver, program: &FlatProgram, input: VarId, sources: &[Source], way: Way) {
    let mut copying = Copying { weaver, program, input, way, within: 0 };
    let mut at = way.from;
    for bit in (0..program.variable(input).bits).rev() {
        let next = if bit == 0 { way.to } else { copying.within() };
        for source in sources {
            copying.step((at, next), bit, source.pattern >> bit & 1 == 1, Some(source));
        }
        at = next;
    }
}

/// Gives the input any value of its domain: control goes through a decision diagram over its bits.
pub fn free(weaver: &mut Weaver, program: &FlatProgram, input: VarId, domain: &Domain, way: Way) {
    let mut copying = Copying { weaver, program, input, way, within: 0 };
    let start = Block::new(domain.ty, program.variable(input).bits, domain.ranges());
    let mut places = BTreeMap::from([(start.clone(), way.from)]);
    let mut queue = VecDeque::from([(start, way.from)]);
    while let Some((block, at)) = queue.pop_front() {
        let Some(bit) = block.highest() else { continue };
        for value in VALUES {
            let half = block.half(value);
            if half.is_empty() {
                continue;
            }
            let next = match places.get(&half) {
                _ if bit == 0 => way.to,
                Some(&known) => known,
                None => {
                    let new = copying.within();
                    places.insert(half.clone(), new);
                    queue.push_back((half, new));
                    new
                }
            };
            copying.step((at, next), bit, value, None);
        }
    }
}

impl Copying<'_> {
    fn within(&mut self) -> PlaceId {
        self.within += 1;
        let name = format!("{}.{}", self.weaver.place_name(self.way.from), self.within);
        self.weaver.place(&name, false, PlaceRole::Copying(self.input, self.within))
    }

    /// Adds the two transitions that give a bit one value, whatever its old value is.
    fn step(&mut self, (at, next): (PlaceId, PlaceId), bit: u32, value: bool, source: Option<&Source>) {
        let place: Bit = self.weaver.variable(self.input)[bit as usize];
        let variable = self.program.variable(self.input);
        let given = source.map(|source| source.place);
        let from = source.map(|source| format!(" from {}", source.name)).unwrap_or_default();
        let which = if variable.ty.is_bool() { String::new() } else { format!("{}.{bit}:", variable.name) };
        for old in VALUES {
            let arcs =
                Arcs { consume: &[at, place.place(old)], produce: &[next, place.place(value)], read: given.as_slice() };
            let label = format!("{}[{which}{}->{}{from}]", self.weaver.place_name(at), u8::from(old), u8::from(value));
            self.weaver.transition(&label, arcs, TransitionRole::Copy { variable: self.input, bit, value });
        }
    }
}
