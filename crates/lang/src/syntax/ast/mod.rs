//! Syntax tree of a text, before names are resolved.

mod configuration;
mod declaration;
mod instruction;
mod literal;
mod operator;

use std::fmt;

pub use configuration::{Configuration, ProgramInstance, Task};
pub use declaration::{Declaration, Initial, InitialKind, Range, TypeDeclaration, TypeSpec, VarBlock, VarKind};
pub use instruction::{
    Argument, Arguments, Condition, Feed, Instruction, Operand, Operation, Part, Path, Subscript, with_nested,
};
pub use literal::{Constant, Literal};
pub use operator::{Operator, Verb};

pub use petril_base::key;
use petril_base::source::Span;

/// Syntax tree of a file: its program organisation units and the declarations around them, each in the order of the
/// text (IEC 61131-3, B.1.5).
#[derive(Clone, Debug, Default)]
pub struct Unit {
    /// Programs, functions and function blocks.
    pub pous: Vec<Pou>,
    /// Data types.
    pub types: Vec<TypeDeclaration>,
    /// `VAR_GLOBAL` blocks of the file and of its configurations.
    pub globals: Vec<VarBlock>,
    /// Configurations.
    pub configurations: Vec<Configuration>,
}

/// Name as it was written. IL does not distinguish upper and lower case: compare [`Name::key`]s.
#[derive(Clone, Debug)]
pub struct Name {
    /// The name with the letters of the text.
    pub text: String,
    /// Span in the text.
    pub span: Span,
}

impl Name {
    /// Key of the name, equal for all its spellings.
    #[must_use]
    pub fn key(&self) -> String {
        key(&self.text)
    }

    /// Whether the name is this word, in any case.
    #[must_use]
    pub fn is(&self, word: &str) -> bool {
        self.text.eq_ignore_ascii_case(word)
    }
}

/// Kinds of program organisation unit (POU).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PouKind {
    /// `PROGRAM`
    Program,
    /// `FUNCTION`
    Function,
    /// `FUNCTION_BLOCK`
    FunctionBlock,
}

impl fmt::Display for PouKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Program => "PROGRAM",
            Self::Function => "FUNCTION",
            Self::FunctionBlock => "FUNCTION_BLOCK",
        })
    }
}

/// Program organisation unit: declarations and an instruction list.
#[derive(Clone, Debug)]
pub struct Pou {
    /// Kind of the unit.
    pub kind: PouKind,
    /// Name of the unit.
    pub name: Name,
    /// Result type of a function.
    pub result: Option<Name>,
    /// Declaration blocks in the order of the text.
    pub blocks: Vec<VarBlock>,
    /// The instruction list.
    pub body: Vec<Instruction>,
    /// Language of a body that is not in IL, and the span that shows it. The language is empty where there is no body
    /// at all.
    pub foreign: Option<(String, Span)>,
}
