//! Layout of composite variables as elementary variables in a row.

use std::collections::BTreeMap;

use super::Lowering;
use super::places::Address;
use crate::flat::{Restriction, Variable};
use crate::semantics::{Area, PouId, Program, Role, Scalar, Section, Shape, Value, VarId, elements};
use petril_base::source::Span;

/// Number of elementary variables that each unit's variables take, and the offset of each in its row.
pub struct Layouts<'p> {
    program: &'p Program,
    known: BTreeMap<PouId, (usize, Vec<usize>)>,
}

impl<'p> Layouts<'p> {
    pub fn new(program: &'p Program) -> Self {
        Self { program, known: BTreeMap::new() }
    }

    /// Number of elementary variables that a shape takes.
    pub fn size(&mut self, shape: &Shape) -> usize {
        match shape {
            Shape::Scalar(_) => 1,
            Shape::Array { ranges, of } => elements(ranges) * self.size(of),
            Shape::Structure(structure) => structure.members.iter().map(|member| self.size(&member.shape)).sum(),
            Shape::Instance(id) => self.instance(*id).0,
        }
    }

    /// Offset of a member of a structure, or of a variable of an instance, in elementary variables.
    pub fn offset(&mut self, shape: &Shape, member: usize) -> usize {
        match shape {
            Shape::Structure(structure) => {
                structure.members[..member].iter().map(|member| self.size(&member.shape)).sum()
            }
            Shape::Instance(id) => self.instance(*id).1[member],
            _ => 0,
        }
    }

    /// Size of an instance and offset of each of its variables, in elementary variables.
    fn instance(&mut self, id: PouId) -> (usize, Vec<usize>) {
        if let Some(known) = self.known.get(&id) {
            return known.clone();
        }
        let mut size = 0;
        let mut offsets = Vec::new();
        for variable in &self.program.pous[&id].variables {
            offsets.push(size);
            if is_kept(variable.section) {
                size += self.size(&variable.shape);
            }
        }
        self.known.insert(id, (size, offsets.clone()));
        (size, offsets)
    }
}

/// Whether an instance keeps a variable of this section from call to call.
pub fn is_kept(section: Section) -> bool {
    matches!(section, Section::Input | Section::Output | Section::Local | Section::Constant)
}

/// Role of a variable of the program.
pub fn role(section: Section, area: Option<Area>) -> Role {
    match (section, area) {
        (Section::Input, _) | (_, Some(Area::Input)) => Role::Input,
        (Section::Output, _) | (_, Some(Area::Output)) => Role::Output,
        (Section::Constant, _) => Role::Constant,
        _ => Role::Memory,
    }
}

/// Common properties of the elementary variables of a shape.
#[derive(Clone)]
pub struct Leaf {
    pub name: String,
    pub role: Role,
    pub span: Span,
}

impl Lowering<'_> {
    /// Adds the elementary variables of a shape; returns the address of the first one.
    pub fn variables_of(&mut self, leaf: &Leaf, shape: &Shape, initial: &Value) -> Address {
        let first = self.variables.len();
        self.add(leaf, shape, initial);
        Address::Direct(first)
    }

    fn add(&mut self, leaf: &Leaf, shape: &Shape, initial: &Value) {
        match shape {
            Shape::Scalar(scalar) => {
                let variable = variable(leaf, scalar, initial);
                self.buffers.take(&variable.name);
                let id = VarId(self.variables.len());
                self.restrictions.extend(Restriction::of(scalar).map(|restriction| (id, restriction)));
                self.variables.push(variable);
            }
            Shape::Array { ranges, of } => {
                let parts = parts(initial);
                for (position, index) in indices(ranges).enumerate() {
                    let name = format!("{}[{index}]", leaf.name);
                    let value = parts.get(&position).copied().unwrap_or(&Value::Default);
                    self.add(&Leaf { name, ..leaf.clone() }, of, value);
                }
            }
            Shape::Structure(structure) => {
                let parts = parts(initial);
                for (position, member) in structure.members.iter().enumerate() {
                    let name = format!("{}.{}", leaf.name, member.name);
                    let value = parts.get(&position).copied().unwrap_or(&member.initial);
                    self.add(&Leaf { name, ..leaf.clone() }, &member.shape, value);
                }
            }
            Shape::Instance(id) => {
                let pou = self.pou(*id);
                let parts = parts(initial);
                let is_library = pou.is_library;
                for (position, inner) in pou.variables.iter().enumerate().filter(|(_, v)| is_kept(v.section)) {
                    let name = format!("{}.{}", leaf.name, inner.name);
                    let role = if inner.section == Section::Constant { Role::Constant } else { Role::Memory };
                    let span = if is_library { leaf.span } else { inner.span };
                    let value = parts.get(&position).copied().unwrap_or(&inner.initial);
                    let first = self.variables.len();
                    self.add(&Leaf { name, role, span }, &inner.shape, value);
                    if !matches!(inner.section, Section::Input | Section::Output) {
                        self.internal.extend((first..self.variables.len()).map(VarId));
                    }
                }
            }
        }
    }

    /// Elementary types of a shape and their initial values, in their order.
    pub fn values(&mut self, shape: &Shape, initial: &Value) -> Vec<(Scalar, u64)> {
        match shape {
            Shape::Scalar(scalar) => vec![(scalar.clone(), pattern(scalar, initial))],
            Shape::Array { ranges, of } => {
                let parts = parts(initial);
                let value = |position| parts.get(&position).copied().unwrap_or(&Value::Default);
                (0..elements(ranges)).flat_map(|position| self.values(of, value(position))).collect()
            }
            Shape::Structure(structure) => {
                let parts = parts(initial);
                let members = structure.members.iter().enumerate();
                members
                    .flat_map(|(i, member)| {
                        self.values(&member.shape, parts.get(&i).copied().unwrap_or(&member.initial))
                    })
                    .collect()
            }
            // Instances are in variables that are never initialised again.
            Shape::Instance(_) => Vec::new(),
        }
    }
}

fn variable(leaf: &Leaf, scalar: &Scalar, initial: &Value) -> Variable {
    let initial = pattern(scalar, initial);
    // An enumeration has few values, and nothing leads to others: it is given constants, copies, and inputs with its
    // values.
    let bits = scalar.enumeration.as_ref().map_or(scalar.ty.width, |e| bits_for(e.values.len() as u64 - 1));
    Variable { name: leaf.name.clone(), role: leaf.role, ty: scalar.ty, bits, initial, span: Some(leaf.span) }
}

/// Number of bits that numbers up to `greatest` need, at least 1.
pub fn bits_for(greatest: u64) -> u32 {
    (u64::BITS - greatest.leading_zeros()).max(1)
}

fn pattern(scalar: &Scalar, initial: &Value) -> u64 {
    match initial {
        Value::Scalar(pattern) => *pattern,
        _ => scalar.default,
    }
}

fn parts(value: &Value) -> BTreeMap<usize, &Value> {
    match value {
        Value::Parts(parts) => {
            parts.iter().flat_map(|(range, value)| range.clone().map(move |position| (position, value))).collect()
        }
        _ => BTreeMap::new(),
    }
}

/// Indices of an array's elements as they are written, the last one fastest.
fn indices(ranges: &[(i64, i64)]) -> impl Iterator<Item = String> {
    let ranges = ranges.to_vec();
    (0..elements(&ranges)).map(move |position| {
        let mut rest = position;
        let mut numbers: Vec<String> = Vec::new();
        for &(lower, upper) in ranges.iter().rev() {
            let length = (upper - lower + 1) as usize;
            numbers.push((lower + (rest % length) as i64).to_string());
            rest /= length;
        }
        numbers.reverse();
        numbers.join(",")
    })
}

/// Variable at an address that is known; the first one if an index selects it.
pub fn direct(address: Address) -> VarId {
    match address {
        Address::Direct(first) => VarId(first),
        Address::Indexed(element) => element.first,
    }
}
