//! Flat code: the seed paper's *Env* and *Code* (Heiner and Menzel, section 2.2).
//!
//! One strictly sequential list of typed instructions: parentheses are buffered in fresh variables, labels are line
//! numbers, a return is a jump to the end. Both the interpreter and the net are made from it.

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

/// A flat program.
///
/// Lines are counted from 0 in the code and from 1 wherever people read them; line `code.len()` is the end.
#[derive(Clone, Debug)]
pub struct FlatProgram {
    /// Name of the program.
    pub name: String,
    /// The declared variables in their order, then the buffers.
    pub variables: Vec<Variable>,
    /// The instructions in their order.
    pub code: Vec<Line>,
    /// Variables whose declarations do not allow every value of their types.
    pub restrictions: BTreeMap<VarId, Restriction>,
    /// Elementary variables with an address, by its one spelling.
    pub addresses: BTreeMap<String, VarId>,
    /// Local variables of function blocks' instances, which nobody but the block itself can name.
    pub internal: BTreeSet<VarId>,
    /// The time from one scan to the next in milliseconds, if a timer depends on it.
    pub scan_time: Option<u64>,
    /// The same whether one does or not.
    pub cycle: u64,
    /// Whether a timer's preset time can be anything, so that its clock stands once it has reached the one it has.
    pub presets_vary: bool,
}

/// A variable of an elementary type. Arrays, structures and instances are many of them, each with a name of its own like
/// `pump.T.Q` or `level[3]`.
#[derive(Clone, Debug)]
pub struct Variable {
    /// The name as it was declared.
    pub name: String,
    /// What it is for.
    pub role: Role,
    /// Its type.
    pub ty: Type,
    /// How many bits of its pattern are stored: those above are always 0. At least 1, at most the type's width.
    pub bits: u32,
    /// Its value at power-on, as a pattern of its type.
    pub initial: u64,
    /// Its declaration, if it has one.
    pub span: Option<Span>,
}

/// One line of flat code.
#[derive(Clone, Debug)]
pub struct Line {
    /// What it does; a jump's target is a line.
    pub instruction: Instruction,
    /// The piece of source it comes from.
    pub span: Span,
}

impl FlatProgram {
    /// The line behind the last one, where every scan ends.
    #[must_use]
    pub fn end(&self) -> usize {
        self.code.len()
    }

    /// A variable.
    #[must_use]
    pub fn variable(&self, id: VarId) -> &Variable {
        &self.variables[id.0]
    }

    /// The variables of a role, in the order of declaration.
    pub fn with_role(&self, role: Role) -> impl Iterator<Item = VarId> + Clone {
        (0..self.variables.len()).map(VarId).filter(move |&id| self.variable(id).role == role)
    }

    /// The variables the user declared; the valuation of these is a scan state.
    pub fn declared(&self) -> impl Iterator<Item = VarId> + Clone {
        (0..self.variables.len()).map(VarId).filter(|&id| self.variable(id).role != Role::Buffer)
    }

    /// The variable of a name, however it is spelt. Buffers have no name that could be asked for.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<VarId> {
        self.declared().find(|&id| self.variable(id).name.eq_ignore_ascii_case(name))
    }

    /// The variable of a name in a formula: as it is declared, or with the program before it, `starter.Motor`, or with PLCverif's word
    /// for the block under check, `instance.Motor`. What is declared goes first.
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

    /// The elementary variable at an address like `%IX0.0`, however it is spelt.
    #[must_use]
    pub fn at(&self, address: &str) -> Option<VarId> {
        self.addresses.get(&spelling(address)).copied()
    }
}
