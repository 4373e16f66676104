//! The syntax tree: what the text says, before anything is known about its names.

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

/// A file: its program organisation units and what stands around them, each in the order of the text (IEC 61131-3, B.1.5).
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

/// A name as it was written. IL does not tell upper from lower case: compare [`Name::key`]s.
#[derive(Clone, Debug)]
pub struct Name {
    /// The name with the letters of the text.
    pub text: String,
    /// Where it stands.
    pub span: Span,
}

impl Name {
    /// The name in the one spelling that all its spellings share.
    #[must_use]
    pub fn key(&self) -> String {
        key(&self.text)
    }

    /// Whether it is this word, however it is spelt.
    #[must_use]
    pub fn is(&self, word: &str) -> bool {
        self.text.eq_ignore_ascii_case(word)
    }
}

/// The three kinds of program organisation unit (POU).
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

/// A program organisation unit: declarations and an instruction list.
#[derive(Clone, Debug)]
pub struct Pou {
    /// Program, function or function block.
    pub kind: PouKind,
    /// Its name.
    pub name: Name,
    /// Result type of a function.
    pub result: Option<Name>,
    /// Declaration blocks in the order of the text.
    pub blocks: Vec<VarBlock>,
    /// The instruction list.
    pub body: Vec<Instruction>,
    /// Where its body is in a language other than IL: the language, and where that shows. The language is empty where there
    /// is no body at all.
    pub foreign: Option<(String, Span)>,
}
