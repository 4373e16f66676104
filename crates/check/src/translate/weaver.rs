//! Building blocks of system nets: bits, places and transitions, each with its role.

use std::collections::BTreeMap;

use smallvec::SmallVec;

use super::provenance::{PlaceRole, Register, TransitionRole};
use petril_lang::flat::Variable;
use petril_lang::semantics::VarId;
use petril_net::net::{Arcs, Builder, Net, PlaceId, TransitionId};

/// Values of a bit.
pub const VALUES: [bool; 2] = [false, true];

/// Bit: two complementary places, exactly one of them marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bit {
    /// Place for 0; that for 1 is the next one.
    zero: PlaceId,
}

impl Bit {
    /// Place that is marked while the bit has this value.
    pub fn place(self, value: bool) -> PlaceId {
        PlaceId::at(self.zero.index() + usize::from(value))
    }

    /// Places for 0 and 1.
    pub fn places(self) -> [PlaceId; 2] {
        VALUES.map(|value| self.place(value))
    }
}

/// Change of a bit in a step: its value before and after. A bit that keeps its value is only read.
pub type Change = (Bit, bool, bool);

/// Changes of bits by a transition. Most change one bit and read another.
pub type Changes = SmallVec<[Change; 4]>;

/// Builder of a net that records the role of each node.
pub struct Weaver {
    builder: Builder,
    place_roles: Vec<PlaceRole>,
    transition_roles: Vec<TransitionRole>,
    result: Vec<Bit>,
    variables: Vec<Vec<Bit>>,
    registers: BTreeMap<(Register, u32), Bit>,
}

/// Finished net with the roles of its nodes.
pub struct Woven {
    pub net: Net,
    pub places: Vec<PlaceRole>,
    pub transitions: Vec<TransitionRole>,
    /// Bits of each variable, from the lowest.
    pub variables: Vec<Vec<Bit>>,
    /// Bits of the current result, from the lowest.
    pub result: Vec<Bit>,
}

impl Weaver {
    pub fn new(name: &str) -> Self {
        Self {
            builder: Builder::new(name),
            place_roles: Vec::new(),
            transition_roles: Vec::new(),
            result: Vec::new(),
            variables: Vec::new(),
            registers: BTreeMap::new(),
        }
    }

    pub fn place(&mut self, name: &str, marked: bool, role: PlaceRole) -> PlaceId {
        self.place_roles.push(role);
        self.builder.place(name, marked)
    }

    /// Number of places.
    pub fn place_count(&self) -> usize {
        self.place_roles.len()
    }

    pub fn place_name(&self, place: PlaceId) -> &str {
        self.builder.place_name(place)
    }

    pub fn transition(&mut self, name: &str, arcs: Arcs<'_>, role: TransitionRole) -> TransitionId {
        self.transition_roles.push(role);
        self.builder.transition(name, arcs)
    }

    /// Adds the stored bits of the next variable. The bit of a `BOOL` has no number in its name.
    pub fn add_variable(&mut self, variable: &Variable) {
        let id = VarId(self.variables.len());
        let name = |bit| if variable.ty.is_bool() { variable.name.clone() } else { format!("{}.{bit}", variable.name) };
        let bits = (0..variable.bits).map(|bit| {
            let role = |value| PlaceRole::Bit { variable: id, bit, value };
            self.bit(&name(bit), variable.initial >> bit & 1 == 1, role)
        });
        let bits = bits.collect();
        self.variables.push(bits);
    }

    /// Adds the current result, 0 at the beginning.
    pub fn add_result(&mut self, name: &str, width: u32) {
        let bit_name = |bit| if width == 1 { name.to_owned() } else { format!("{name}.{bit}") };
        let bits =
            (0..width).map(|bit| self.bit(&bit_name(bit), false, |value| PlaceRole::Result { bit, value })).collect();
        self.result = bits;
    }

    fn bit(&mut self, name: &str, initial: bool, role: impl Fn(bool) -> PlaceRole) -> Bit {
        let [zero, _] = VALUES.map(|value| {
            let place = format!("{name}={}", u8::from(value));
            self.place(&place, value == initial, role(value))
        });
        Bit { zero }
    }

    /// Bits of a variable, from the lowest; those above are 0.
    pub fn variable(&self, variable: VarId) -> &[Bit] {
        &self.variables[variable.0]
    }

    /// Bits of the current result, from the lowest.
    pub fn result(&self) -> &[Bit] {
        &self.result
    }

    /// Bit of an auxiliary register, added on first use. An apostrophe is in no name of a variable.
    pub fn register(&mut self, register: Register, bit: u32) -> Bit {
        if let Some(&known) = self.registers.get(&(register, bit)) {
            return known;
        }
        let name = if register == Register::Mark { format!("{register}'") } else { format!("{register}'.{bit}") };
        let new = self.bit(&name, false, |value| PlaceRole::Register { register, bit, value });
        self.registers.insert((register, bit), new);
        new
    }

    /// Builds the net.
    pub fn build(self) -> Woven {
        Woven {
            net: self.builder.build(),
            places: self.place_roles,
            transitions: self.transition_roles,
            variables: self.variables,
            result: self.result,
        }
    }
}
