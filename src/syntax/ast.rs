//! The syntax tree: what the text says, before anything is known about its names.

use std::fmt;

use crate::source::Span;

/// A file: its program organisation units in the order of the text (IEC 61131-3, B.1.5).
#[derive(Clone, Debug, Default)]
pub struct Unit {
    /// Programs, functions and function blocks.
    pub pous: Vec<Pou>,
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
}

/// A name in the one spelling that all its spellings share.
#[must_use]
pub fn key(name: &str) -> String {
    name.to_ascii_uppercase()
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
}

/// The kinds of declaration block (B.1.4.3, B.1.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VarKind {
    /// `VAR`
    Local,
    /// `VAR_INPUT`
    Input,
    /// `VAR_OUTPUT`
    Output,
    /// `VAR_IN_OUT`
    InOut,
    /// `VAR_TEMP`
    Temp,
    /// `VAR_EXTERNAL`
    External,
    /// `VAR_GLOBAL`
    Global,
}

impl fmt::Display for VarKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Local => "VAR",
            Self::Input => "VAR_INPUT",
            Self::Output => "VAR_OUTPUT",
            Self::InOut => "VAR_IN_OUT",
            Self::Temp => "VAR_TEMP",
            Self::External => "VAR_EXTERNAL",
            Self::Global => "VAR_GLOBAL",
        })
    }
}

/// One block from `VAR…` to `END_VAR`.
#[derive(Clone, Debug)]
pub struct VarBlock {
    /// Which kind of variables it declares.
    pub kind: VarKind,
    /// `CONSTANT` was written.
    pub constant: bool,
    /// `RETAIN` or `NON_RETAIN`, as written.
    pub retain: Option<Name>,
    /// Its declarations.
    pub declarations: Vec<Declaration>,
    /// Where its first word stands.
    pub span: Span,
}

/// One declaration: `a, b : BOOL := TRUE;`.
#[derive(Clone, Debug)]
pub struct Declaration {
    /// The declared names.
    pub names: Vec<Name>,
    /// Directly represented location after `AT`.
    pub location: Option<Name>,
    /// The type, as written; `None` if the declaration could not be read, which has been reported.
    pub type_text: Option<Name>,
    /// The initial value.
    pub initial: Option<Constant>,
}

/// A literal (B.1.2).
#[derive(Clone, Debug)]
pub struct Constant {
    /// As written.
    pub text: String,
    /// Its value if it is a Boolean literal: `TRUE`, `FALSE`, `1`, `0`, with or without `BOOL#`.
    pub boolean: Option<bool>,
    /// Where it stands.
    pub span: Span,
}

/// One instruction, or a label that stands alone.
#[derive(Clone, Debug)]
pub struct Instruction {
    /// The label before it.
    pub label: Option<Name>,
    /// What it does; `None` for a label that stands alone.
    pub operation: Option<Operation>,
    /// The whole instruction; for a parenthesis its first line.
    pub span: Span,
}

/// The instructions of a list and of all parentheses in it, in the order of the text, each with its nesting depth.
pub fn with_nested(body: &[Instruction]) -> impl Iterator<Item = (&Instruction, usize)> {
    let mut stack = vec![body.iter()];
    std::iter::from_fn(move || {
        loop {
            let depth = stack.len().checked_sub(1)?;
            let Some(instruction) = stack[depth].next() else {
                stack.pop();
                continue;
            };
            if let Some(Operation::Parenthesis { body, .. }) = &instruction.operation {
                stack.push(body.iter());
            }
            return Some((instruction, depth));
        }
    })
}

/// What an instruction does (B.2.1).
#[derive(Clone, Debug)]
pub enum Operation {
    /// An operator with its operands. One is the rule; the static rules look after the others.
    Simple {
        /// The operator.
        operator: Operator,
        /// What stands behind it.
        operands: Vec<Operand>,
    },
    /// `AND( operand … )`: the operator waits for the value of the parenthesis.
    Parenthesis {
        /// The deferred operator.
        operator: Operator,
        /// The operand behind the opening parenthesis, loaded first.
        first: Option<Operand>,
        /// The instructions inside.
        body: Vec<Instruction>,
        /// The closing parenthesis.
        close: Span,
    },
    /// `JMP`, `JMPC`, `JMPCN`.
    Jump {
        /// When it jumps.
        condition: Condition,
        /// Where to.
        target: Name,
    },
    /// `RET`, `RETC`, `RETCN`.
    Return {
        /// When it returns.
        condition: Condition,
    },
    /// `CAL`, `CALC`, `CALCN` of a function block instance.
    Call {
        /// The operator and the instance called.
        callee: Name,
    },
    /// A function called by its name, or a first word nobody knows.
    Function {
        /// The first word.
        name: Name,
    },
    /// A line that could not be read, which has been reported. It keeps the rules from reporting what follows from that.
    Broken,
}

/// An operator with its modifier N.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Operator {
    /// What it does.
    pub verb: Verb,
    /// The modifier N: the operand, the value of the parenthesis, or the stored value is complemented.
    pub negated: bool,
}

macro_rules! verbs {
    ($($name:ident = $word:literal,)+) => {
        /// The operators of edition 2, table 52 (without jump, call and return).
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs, reason = "each is named by its word")]
        pub enum Verb { $($name,)+ }

        impl Verb {
            /// Every operator with its word.
            pub const ALL: &'static [(Verb, &'static str)] = &[$((Verb::$name, $word)),+];
        }
    };
}

verbs! {
    Ld = "LD", St = "ST", Not = "NOT", S = "S", R = "R", S1 = "S1", R1 = "R1", Clk = "CLK", Cu = "CU", Cd = "CD",
    Pv = "PV", In = "IN", Pt = "PT", And = "AND", Or = "OR", Xor = "XOR", Add = "ADD", Sub = "SUB", Mul = "MUL",
    Div = "DIV", Mod = "MOD", Gt = "GT", Ge = "GE", Eq = "EQ", Lt = "LT", Le = "LE", Ne = "NE",
}

impl Verb {
    /// The operator's word.
    #[must_use]
    pub fn word(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// Whether it works on single bits: loads, stores, and the Boolean functions.
    #[must_use]
    pub fn is_boolean(self) -> bool {
        matches!(self, Self::Ld | Self::St | Self::S | Self::R | Self::Not | Self::And | Self::Or | Self::Xor)
    }
}

impl fmt::Display for Operator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.verb.word(), if self.negated { "N" } else { "" })
    }
}

/// When a jump or return is taken: always, if the current result is TRUE (C), or if it is FALSE (CN).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// No modifier.
    Always,
    /// Modifier C.
    IfTrue,
    /// Modifiers C and N.
    IfFalse,
}

impl Condition {
    /// The modifier as it is written behind the operator.
    #[must_use]
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Always => "",
            Self::IfTrue => "C",
            Self::IfFalse => "CN",
        }
    }
}

/// An operand: a literal or a variable.
#[derive(Clone, Debug)]
pub enum Operand {
    /// A literal.
    Constant(Constant),
    /// A variable, as written: `x`, `timer.Q`, `%IX0.0`.
    Variable(Name),
}

impl Operand {
    /// Where it stands.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Constant(constant) => constant.span,
            Self::Variable(name) => name.span,
        }
    }
}
