//! Instruction lists (B.2.1).

use std::fmt;

use super::{Constant, Name, Operator};
use petril_base::source::Span;

/// Instruction, or a label that stands alone.
#[derive(Clone, Debug)]
pub struct Instruction {
    /// Label before the instruction.
    pub label: Option<Name>,
    /// Operation; `None` for a label that stands alone.
    pub operation: Option<Operation>,
    /// Span of the whole instruction; for a parenthesis of its first line.
    pub span: Span,
}

impl Instruction {
    /// Nested lists, in the order of the text: the body of a parenthesis, or the lists that compute inputs of a call.
    #[must_use]
    pub fn lists(&self) -> Vec<&[Instruction]> {
        match &self.operation {
            Some(Operation::Parenthesis { body, .. }) => vec![body],
            Some(Operation::Call { arguments, .. } | Operation::Function { arguments, .. }) => {
                let lists = arguments.list.iter().filter_map(|argument| match argument {
                    Argument::Input { value: Feed::List(list), .. } => Some(list.as_slice()),
                    _ => None,
                });
                lists.collect()
            }
            _ => Vec::new(),
        }
    }
}

/// Iterator over the instructions of a list and of all lists in it, in the order of the text, each with its nesting
/// depth.
pub fn with_nested(body: &[Instruction]) -> impl Iterator<Item = (&Instruction, usize)> {
    let mut open = vec![(body.iter(), 0)];
    std::iter::from_fn(move || {
        loop {
            let (list, depth) = open.last_mut()?;
            let depth = *depth;
            if let Some(instruction) = list.next() {
                open.extend(instruction.lists().into_iter().rev().map(|list| (list.iter(), depth + 1)));
                return Some((instruction, depth));
            }
            open.pop();
        }
    })
}

/// Operation of an instruction (B.2.1).
#[derive(Clone, Debug)]
pub enum Operation {
    /// Operator with its operands. Usually there is one; the static rules check the number.
    Simple {
        /// The operator.
        operator: Operator,
        /// Operands after the operator.
        operands: Vec<Operand>,
    },
    /// `AND( operand … )`: the operator waits for the value of the parenthesis.
    Parenthesis {
        /// The deferred operator.
        operator: Operator,
        /// Operand after the opening parenthesis, loaded first.
        first: Option<Operand>,
        /// Instructions inside the parenthesis.
        body: Vec<Instruction>,
        /// Span of the closing parenthesis.
        close: Span,
    },
    /// `JMP`, `JMPC`, `JMPCN`.
    Jump {
        /// Condition of the jump.
        condition: Condition,
        /// Label jumped to.
        target: Name,
    },
    /// `RET`, `RETC`, `RETCN`.
    Return {
        /// Condition of the return.
        condition: Condition,
    },
    /// `CAL`, `CALC`, `CALCN` of a function block instance.
    Call {
        /// Condition of the call.
        condition: Condition,
        /// Instance called.
        callee: Path,
        /// Arguments of the call.
        arguments: Arguments,
    },
    /// Function called by its name, or an unknown first word.
    Function {
        /// The first word.
        name: Name,
        /// Arguments of the call.
        arguments: Arguments,
    },
    /// Line that could not be read, which has been reported. Keeps the static rules from reporting consequences.
    Broken,
}

/// Condition of a jump, return or call: always, if the current result is TRUE (C), or if it is FALSE (CN).
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
    /// Modifier as written after the operator.
    #[must_use]
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Always => "",
            Self::IfTrue => "C",
            Self::IfFalse => "CN",
        }
    }
}

/// Operand: a literal or a variable.
#[derive(Clone, Debug)]
pub enum Operand {
    /// A literal.
    Constant(Constant),
    /// A variable.
    Variable(Path),
}

impl Operand {
    /// Span of the operand in the text.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Constant(constant) => constant.span,
            Self::Variable(path) => path.span,
        }
    }
}

/// Variable or a part of one: `x`, `timer.Q`, `level[3]`, `%IX0.0`.
#[derive(Clone, Debug)]
pub struct Path {
    /// The first name, or a directly represented variable.
    pub root: Name,
    /// Members and indices after the root.
    pub parts: Vec<Part>,
    /// Span of the whole path.
    pub span: Span,
}

impl Path {
    /// Name of the variable, if the path has no members or indices.
    #[must_use]
    pub fn plain(&self) -> Option<&Name> {
        self.parts.is_empty().then_some(&self.root)
    }
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.root.text)?;
        self.parts.iter().try_for_each(|part| match part {
            Part::Member(name) => write!(f, ".{}", name.text),
            Part::Index(indices, _) => {
                let indices: Vec<String> = indices.iter().map(ToString::to_string).collect();
                write!(f, "[{}]", indices.join(","))
            }
        })
    }
}

/// Step of a path, from a variable to a part of it.
#[derive(Clone, Debug)]
pub enum Part {
    /// `.Q`
    Member(Name),
    /// `[3, i]`, with its span.
    Index(Vec<Subscript>, Span),
}

/// Index of an array.
#[derive(Clone, Debug)]
pub enum Subscript {
    /// A literal.
    Constant(Constant),
    /// A variable.
    Variable(Path),
}

impl fmt::Display for Subscript {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(constant) => f.write_str(&constant.text),
            Self::Variable(path) => path.fmt(f),
        }
    }
}

/// Arguments of a call of a function or function block.
#[derive(Clone, Debug, Default)]
pub struct Arguments {
    /// Arguments in the order of the text.
    pub list: Vec<Argument>,
    /// Whether the arguments stand in parentheses. After a function's name without parentheses, the current result is
    /// the first input, before the arguments.
    pub enclosed: bool,
}

/// Argument of a call.
#[derive(Clone, Debug)]
pub enum Argument {
    /// `x`, at its position.
    Positional(Operand),
    /// `IN := x`
    Input {
        /// Name of the input.
        name: Name,
        /// Value of the input.
        value: Feed,
    },
    /// `Q => x`, `NOT Q => x`
    Output {
        /// Whether `NOT` was written.
        negated: bool,
        /// Name of the output.
        name: Name,
        /// Variable that receives the output.
        target: Operand,
    },
}

/// Value of an input.
#[derive(Clone, Debug)]
pub enum Feed {
    /// An operand.
    Operand(Operand),
    /// `( LD x … )`: the current result at the end of a list.
    List(Vec<Instruction>),
}
