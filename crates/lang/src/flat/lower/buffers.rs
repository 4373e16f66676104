//! Buffers: variables that flattening adds.

use std::collections::{BTreeMap, BTreeSet};

use super::Lowering;
use crate::flat::Variable;
use crate::semantics::{PouId, Role, Type, VarId};
use crate::syntax::ast::key;

use super::places::Address;

/// Buffers made so far.
#[derive(Default)]
pub struct Buffers {
    /// Names in use.
    taken: BTreeSet<String>,
    /// Number of letters tried as names.
    letters: usize,
    /// Buffers of left operands, by type and nesting depth of the parenthesis: the current result while it is computed.
    left: BTreeMap<(Type, usize), VarId>,
    /// Buffers of right operands, by type: the value of a parenthesis until its operator takes it.
    right: BTreeMap<Type, VarId>,
    /// Indices of elements that in-out variables stand for, held while their call lasts.
    held: BTreeSet<VarId>,
    /// Unused buffers, by type and number of bits.
    free: BTreeMap<(Type, u32), Vec<VarId>>,
    /// Variables of functions, and those of function blocks that are initialised at each call.
    pub units: BTreeMap<PouId, Vec<Option<Address>>>,
}

impl Buffers {
    /// Marks a name as used.
    pub fn take(&mut self, name: &str) {
        self.taken.insert(key(name));
    }
}

impl Lowering<'_> {
    /// Buffers of a parenthesis at a nesting depth: for the left operand, and for the value of the parenthesis.
    pub fn parenthesis_buffers(&mut self, ty: Type, depth: usize) -> (VarId, VarId) {
        let left = match self.buffers.left.get(&(ty, depth)) {
            Some(&left) => left,
            None => {
                let left = self.fresh(ty, ty.width);
                self.buffers.left.insert((ty, depth), left);
                left
            }
        };
        let right = match self.buffers.right.get(&ty) {
            Some(&right) => right,
            None => self.fresh(ty, ty.width),
        };
        self.buffers.right.insert(ty, right);
        (left, right)
    }

    /// Takes a buffer of a type that stores `bits` bits, until it is released.
    pub fn acquire(&mut self, ty: Type, bits: u32) -> VarId {
        match self.buffers.free.get_mut(&(ty, bits)).and_then(Vec::pop) {
            Some(buffer) => buffer,
            None => self.fresh(ty, bits),
        }
    }

    /// Releases a buffer for reuse, unless it is held as an index.
    pub fn release(&mut self, buffer: VarId) {
        if self.buffers.held.contains(&buffer) {
            return;
        }
        let variable = &self.variables[buffer.0];
        let free = self.buffers.free.entry((variable.ty, variable.bits)).or_default();
        debug_assert!(!free.contains(&buffer), "a buffer is released once");
        free.push(buffer);
    }

    /// Keeps the index of an address from being released until [`Lowering::let_go`]; returns it, unless it is held
    /// already.
    pub fn hold(&mut self, address: Address) -> Option<VarId> {
        let Address::Indexed(element) = address else { return None };
        self.buffers.held.insert(element.index).then_some(element.index)
    }

    /// Releases an index that was held.
    pub fn let_go(&mut self, index: VarId) {
        self.buffers.held.remove(&index);
        self.release(index);
    }

    /// Makes an unused name from this one, by appending a number if necessary.
    pub fn unused(&mut self, name: &str) -> String {
        let numbered = (1..).map(|number| format!("{name}_{number}"));
        let mut names = [name.to_owned()].into_iter().chain(numbered);
        let name = names.find(|name| !self.buffers.taken.contains(&key(name))).unwrap_or_default();
        self.buffers.take(&name);
        name
    }

    /// Adds a variable named by the first of A, B, …, Z, A1, B1, … that is not in use.
    fn fresh(&mut self, ty: Type, bits: u32) -> VarId {
        let name = loop {
            let letter = char::from(b'A' + (self.buffers.letters % 26) as u8);
            let round = self.buffers.letters / 26;
            let name = if round == 0 { letter.to_string() } else { format!("{letter}{round}") };
            self.buffers.letters += 1;
            if self.buffers.taken.insert(key(&name)) {
                break name;
            }
        };
        self.variables.push(Variable { name, role: Role::Buffer, ty, bits, initial: 0, span: None });
        VarId(self.variables.len() - 1)
    }
}
