//! Flat code: the seed paper's *Env* and *Code* (Heiner and Menzel, section 2.2).
//!
//! Strictly sequential list of typed instructions: parentheses are buffered in fresh variables, labels are line
//! numbers, a return is a jump to the end. Interpreter and net are both made from it.

mod carried;
mod compared;
mod instruction;
mod lower;
mod narrow;
mod print;
mod restriction;
mod tolerated;
mod value;

pub use compared::Cuts;
pub use lower::{DEFAULT_SCAN_TIME, flatten, flatten_with};
pub use print::literal;
pub use restriction::Restriction;
pub use tolerated::Tolerated;
pub use value::value_text;

pub use instruction::{Condition, Element, Function, Hazard, Instruction, Operand, Target};

use std::collections::{BTreeMap, BTreeSet};

use crate::semantics::{Role, Type, VarId, spelling};
use petril_base::source::Span;

/// Program as flat code.
///
/// Lines are counted from 0 in the code and from 1 wherever people read them; line `code.len()` is the end.
#[derive(Clone, Debug)]
pub struct FlatProgram {
    /// Name of the program.
    pub name: String,
    /// Declared variables in their order, then the buffers.
    pub variables: Vec<Variable>,
    /// Instructions in their order.
    pub code: Vec<Line>,
    /// Variables whose declarations do not allow every value of their types.
    pub restrictions: BTreeMap<VarId, Restriction>,
    /// Elementary variables with an address, by the address in its standard spelling.
    pub addresses: BTreeMap<String, VarId>,
    /// Local variables of function block instances, which only the block itself can name.
    pub internal: BTreeSet<VarId>,
    /// Scan time in milliseconds, if a timer depends on it.
    pub scan_time: Option<u64>,
    /// Scan time in milliseconds, whether or not a timer depends on it.
    pub cycle: u64,
    /// Whether some timer's preset time has no known maximum, so that its clock stops at the preset time it has at the
    /// moment.
    pub presets_vary: bool,
}

/// Variable of an elementary type. Arrays, structures and instances are split into many of them, each with a name of
/// its own like `pump.T.Q` or `level[3]`.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Name as it was declared.
    pub name: String,
    /// Role: input, output, memory, constant or buffer.
    pub role: Role,
    /// Elementary type.
    pub ty: Type,
    /// Number of stored bits of the pattern: those above are always 0. At least 1, at most the type's width.
    pub bits: u32,
    /// Value at power-on, as a pattern of the type.
    pub initial: u64,
    /// Span of the declaration, if there is one.
    pub span: Option<Span>,
}

/// Line of flat code.
#[derive(Clone, Debug)]
pub struct Line {
    /// Instruction; a jump's target is a line.
    pub instruction: Instruction,
    /// Span of the source that the line comes from.
    pub span: Span,
}

impl FlatProgram {
    /// Line after the last one, where every scan ends.
    #[must_use]
    pub fn end(&self) -> usize {
        self.code.len()
    }

    /// Variable with an id.
    #[must_use]
    pub fn variable(&self, id: VarId) -> &Variable {
        &self.variables[id.0]
    }

    /// Variables with a role, in the order of declaration.
    pub fn with_role(&self, role: Role) -> impl Iterator<Item = VarId> + Clone {
        (0..self.variables.len()).map(VarId).filter(move |&id| self.variable(id).role == role)
    }

    /// Variables that the user declared; their valuation is a state of the scan view.
    pub fn declared(&self) -> impl Iterator<Item = VarId> + Clone {
        (0..self.variables.len()).map(VarId).filter(|&id| self.variable(id).role != Role::Buffer)
    }

    /// Variable with a name, in any case. Buffers cannot be found by name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<VarId> {
        self.declared().find(|&id| self.variable(id).name.eq_ignore_ascii_case(name))
    }

    /// Variable with a name in a formula: as it is declared, or with the program before it, `starter.Motor`, or with
    /// PLCverif's word for the block under check, `instance.Motor`. Declared names take precedence.
    #[must_use]
    pub fn named(&self, name: &str) -> Option<VarId> {
        self.find(name).or_else(|| {
            let (block, rest) = name.split_once('.')?;
            let is_block = block.eq_ignore_ascii_case("instance") || block.eq_ignore_ascii_case(&self.name);
            let is_declared = self.declared().any(|id| {
                let first = self.variable(id).name.split(['.', '[']).next();
                first.is_some_and(|first| first.eq_ignore_ascii_case(block))
            });
            self.find(rest).filter(|_| is_block && !is_declared)
        })
    }

    /// Elementary variable at an address like `%IX0.0`, in any spelling.
    #[must_use]
    pub fn at(&self, address: &str) -> Option<VarId> {
        self.addresses.get(&spelling(address)).copied()
    }
}
