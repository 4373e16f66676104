//! The checked program: names resolved to variables, labels to positions.

use crate::source::Span;
pub use crate::syntax::ast::Condition;

/// A program that satisfies every static rule.
#[derive(Clone, Debug)]
pub struct Program {
    /// Its name.
    pub name: String,
    /// Its variables in the order of declaration; [`VarId`] is the position.
    pub variables: Vec<Variable>,
    /// Its instructions.
    pub body: Vec<Statement>,
}

/// A variable, as a position in the program's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct VarId(pub usize);

/// A Boolean variable.
#[derive(Clone, Debug)]
pub struct Variable {
    /// The name as it was declared.
    pub name: String,
    /// What it is for.
    pub role: Role,
    /// Its value at power-on.
    pub initial: bool,
    /// Its declaration, if it has one.
    pub span: Option<Span>,
}

/// What a variable is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// `VAR_INPUT`: given by the plant before every scan.
    Input,
    /// `VAR`: keeps its value from scan to scan.
    Memory,
    /// `VAR_OUTPUT`: taken by the plant after every scan; keeps its value too.
    Output,
    /// `CONSTANT`: never changes.
    Constant,
    /// Made by flattening to hold a value while a parenthesis is computed; nothing of it survives the scan.
    Buffer,
}

/// An instruction and where it stands.
#[derive(Clone, Debug)]
pub struct Statement {
    /// What it does.
    pub action: Action,
    /// Where it stands; for a parenthesis its first line.
    pub span: Span,
}

/// What a statement does.
#[derive(Clone, Debug)]
pub enum Action {
    /// One instruction.
    Plain(Instruction),
    /// An operator deferred to the end of a parenthesis.
    Defer {
        /// The function.
        function: Function,
        /// Modifier N: the value of the parenthesis is complemented.
        negated: bool,
        /// Loaded before the instructions inside, if given.
        first: Option<(Operand, Span)>,
        /// The instructions inside.
        body: Vec<Statement>,
        /// The closing parenthesis.
        close: Span,
    },
}

/// What an instruction does to the memory and the current result (CR).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instruction {
    /// `LD`, `LDN`: CR := operand, complemented if `negated`.
    Load {
        /// Modifier N.
        negated: bool,
        /// What is loaded.
        operand: Operand,
    },
    /// `ST`, `STN`: variable := CR, complemented if `negated`.
    Store {
        /// Modifier N.
        negated: bool,
        /// Where to.
        variable: VarId,
    },
    /// `S`: variable := TRUE if CR is TRUE.
    Set(VarId),
    /// `R`: variable := FALSE if CR is TRUE.
    Reset(VarId),
    /// `NOT`: CR := NOT CR.
    Complement,
    /// `AND`, `OR`, `XOR`: CR := CR function operand, the operand complemented if `negated`.
    Combine {
        /// The function.
        function: Function,
        /// Modifier N.
        negated: bool,
        /// The right operand.
        operand: Operand,
    },
    /// `JMP…` and `RET…`: go on at `target` if the condition holds of CR.
    Jump {
        /// When.
        condition: Condition,
        /// Position in the list the instruction belongs to, from 0; its length stands for the end.
        target: usize,
    },
}

/// The Boolean functions of two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// Conjunction.
    And,
    /// Disjunction.
    Or,
    /// Exclusive disjunction.
    Xor,
}

/// Where an instruction takes its operand from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// The value of a variable.
    Variable(VarId),
    /// A literal.
    Constant(bool),
}
