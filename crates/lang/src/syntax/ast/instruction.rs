//! Instruction lists (B.2.1).

use std::fmt;

use super::{Constant, Name, Operator};
use petril_base::source::Span;

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

impl Instruction {
    /// The lists inside it, in the order of the text: that of a parenthesis, or those that give inputs of a call their values.
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

/// The instructions of a list and of all lists in it, in the order of the text, each with its nesting depth.
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
        /// When it calls.
        condition: Condition,
        /// The instance.
        callee: Path,
        /// What is handed over.
        arguments: Arguments,
    },
    /// A function called by its name, or a first word nobody knows.
    Function {
        /// The first word.
        name: Name,
        /// What is handed over.
        arguments: Arguments,
    },
    /// A line that could not be read, which has been reported. It keeps the rules from reporting what follows from that.
    Broken,
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
    /// A variable.
    Variable(Path),
}

impl Operand {
    /// Where it stands.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Constant(constant) => constant.span,
            Self::Variable(path) => path.span,
        }
    }
}

/// A variable or a part of one: `x`, `timer.Q`, `level[3]`, `%IX0.0`.
#[derive(Clone, Debug)]
pub struct Path {
    /// The first name, or a directly represented variable.
    pub root: Name,
    /// Members and indices behind it.
    pub parts: Vec<Part>,
    /// The whole.
    pub span: Span,
}

impl Path {
    /// The name, if that is all of it.
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

/// A step from a variable to a part of it.
#[derive(Clone, Debug)]
pub enum Part {
    /// `.Q`
    Member(Name),
    /// `[3, i]`, and where it stands.
    Index(Vec<Subscript>, Span),
}

/// One index.
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

/// What is handed over to a function or function block.
#[derive(Clone, Debug, Default)]
pub struct Arguments {
    /// In the order of the text.
    pub list: Vec<Argument>,
    /// Whether they stand in parentheses. Behind a function's name without parentheses, the current result comes before
    /// them.
    pub enclosed: bool,
}

/// One of them.
#[derive(Clone, Debug)]
pub enum Argument {
    /// `x`, at its position.
    Positional(Operand),
    /// `IN := x`
    Input {
        /// The input.
        name: Name,
        /// Its value.
        value: Feed,
    },
    /// `Q => x`, `NOT Q => x`
    Output {
        /// `NOT` was written.
        negated: bool,
        /// The output.
        name: Name,
        /// Where its value goes.
        target: Operand,
    },
}

/// The value of an input.
#[derive(Clone, Debug)]
pub enum Feed {
    /// An operand.
    Operand(Operand),
    /// `( LD x … )`: the result of a list.
    List(Vec<Instruction>),
}
