//! The checked program: names resolved to variables, labels to positions, every value typed.

use std::collections::BTreeMap;

use super::address::Area;
use super::function::Function;
use super::shape::{PouId, Scalar, Shape, Value};
use super::symbols::Section;
pub use crate::syntax::ast::{Condition, PouKind};
use petril_base::Type;
use petril_base::source::Span;

/// A program that satisfies every static rule, with all it calls.
#[derive(Clone, Debug)]
pub struct Program {
    /// The units it needs.
    pub pous: BTreeMap<PouId, Pou>,
    /// The one that is executed once in every scan.
    pub entry: PouId,
    /// The global variables.
    pub globals: Vec<Variable>,
    /// The time from one scan to the next, in milliseconds, if a task says so.
    pub interval: Option<u64>,
}

/// A program organisation unit.
#[derive(Clone, Debug)]
pub struct Pou {
    /// Its name.
    pub name: String,
    /// Program, function or function block.
    pub kind: PouKind,
    /// Whether it is one of the standard's, which have no text in the user's file.
    pub is_library: bool,
    /// Its variables in the order of declaration.
    pub variables: Vec<Variable>,
    /// Its instructions.
    pub body: Vec<Statement>,
    /// What each [`TypeId`] of the body is.
    pub types: Vec<Type>,
    /// What each [`Operand::Literal`] of the body is, as a pattern.
    pub literals: Vec<u64>,
}

/// A variable of a unit.
#[derive(Clone, Debug)]
pub struct Variable {
    /// The name as it was declared.
    pub name: String,
    /// In which block.
    pub section: Section,
    /// What it is.
    pub shape: Shape,
    /// Its value at power-on, or at each call.
    pub initial: Value,
    /// The area of its address.
    pub area: Option<Area>,
    /// Its address in the one spelling that all its spellings share.
    pub address: Option<String>,
    /// Its declaration.
    pub span: Span,
}

/// What a variable of flat code is for.
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
    /// Holds a value for a while, like that of a parenthesis or of a function's variable; nothing of it survives the scan.
    Buffer,
}

/// A type, as a position in [`Pou::types`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TypeId(pub usize);

/// An instruction and where it stands.
#[derive(Clone, Debug)]
pub struct Statement {
    /// What it does.
    pub action: Action,
    /// Where it stands; for a parenthesis its first line.
    pub span: Span,
}

/// What an instruction does to the memory and the current result (CR).
#[derive(Clone, Debug)]
pub enum Action {
    /// `LD`, `LDN`
    Load {
        /// The type of operand and CR.
        ty: TypeId,
        /// Modifier N.
        negated: bool,
        /// What is loaded.
        operand: Operand,
    },
    /// `ST`, `STN`
    Store {
        /// The type of place and CR.
        ty: TypeId,
        /// Modifier N.
        negated: bool,
        /// Where to.
        place: Place,
    },
    /// `S`
    Set(Place),
    /// `R`
    Reset(Place),
    /// `NOT`
    Complement(TypeId),
    /// An operator with its operand.
    Combine {
        /// The function.
        function: Function,
        /// The type of CR and operand.
        ty: TypeId,
        /// Modifier N.
        negated: bool,
        /// The right operand.
        operand: Operand,
    },
    /// An operator deferred to the end of a parenthesis.
    Defer {
        /// The function.
        function: Function,
        /// The type of CR and of the value of the parenthesis.
        ty: TypeId,
        /// Modifier N: the value of the parenthesis is complemented.
        negated: bool,
        /// The instructions inside.
        body: Vec<Statement>,
        /// The closing parenthesis.
        close: Span,
    },
    /// `JMP…`: go on at this position of the unit's body, its length standing for the end.
    Jump(Condition, usize),
    /// `RET…`
    Return(Condition),
    /// A call of a function block or of a function of the file.
    Call(Box<Call>),
    /// A standard function.
    Standard(Box<Standard>),
}

/// Where a value comes from.
#[derive(Clone, Debug)]
pub enum Operand {
    /// A variable.
    Place(Place),
    /// A literal, as a position in [`Pou::literals`].
    Literal(usize),
}

/// A variable or a part of one.
#[derive(Clone, Debug)]
pub struct Place {
    /// The variable it is part of.
    pub root: Root,
    /// The way from there.
    pub steps: Vec<Step>,
    /// What it is.
    pub shape: Shape,
    /// Where it is named.
    pub span: Span,
}

impl Place {
    /// What is known of an elementary one; another has been refused where only such may stand.
    #[must_use]
    pub fn scalar(&self) -> Scalar {
        self.shape.scalar().cloned().unwrap_or_else(|| Scalar::new(Type::BOOL))
    }
}

/// A variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Root {
    /// One of the unit's own, by position.
    Own(usize),
    /// A global one, by position.
    Global(usize),
}

/// A step from a variable to a part of it.
#[derive(Clone, Debug)]
pub enum Step {
    /// The member of a structure, or the variable of a function block, at this position.
    Member(usize),
    /// The element with these indices, one for each range.
    Index(Vec<Index>),
}

/// One index.
#[derive(Clone, Debug)]
pub enum Index {
    /// A number, inside its range.
    Constant(i64),
    /// An elementary variable.
    Variable(Place),
}

/// A call.
#[derive(Clone, Debug)]
pub struct Call {
    /// When it calls; parameters are handed over only then.
    pub condition: Condition,
    /// What is called.
    pub callee: Callee,
    /// The variable that CR is stored in first, and its type.
    pub result_to: Option<(usize, TypeId)>,
    /// Values for variables of the callee, in the order of the text.
    pub inputs: Vec<(usize, Feed)>,
    /// Variables of the caller for the in-out variables of the callee.
    pub in_outs: Vec<(usize, Place)>,
    /// Variables of the caller that get outputs, in the order of the text; complemented if `true`.
    pub outputs: Vec<(usize, bool, Place)>,
    /// `EN` and `ENO`.
    pub enable: Enable,
    /// Number of outputs that are written before `ENO`.
    pub before_eno: usize,
}

/// What is called.
#[derive(Clone, Debug)]
pub enum Callee {
    /// An instance of a function block.
    Instance(PouId, Place),
    /// A function.
    Function(PouId),
}

/// The parameters `EN` and `ENO` of a call (2.5.1.2).
#[derive(Clone, Debug, Default)]
pub struct Enable {
    /// Whether it is executed.
    pub en: Option<Feed>,
    /// Gets whether it was, after the call; complemented if `true`.
    pub eno: Option<(bool, Place)>,
}

/// A value that is handed over, with its type.
#[derive(Clone, Debug)]
pub struct Feed {
    /// Its type.
    pub ty: TypeId,
    /// Where it comes from.
    pub source: FeedSource,
    /// Where it stands.
    pub span: Span,
}

/// Where a value that is handed over comes from.
#[derive(Clone, Debug)]
pub enum FeedSource {
    /// The current result.
    Result,
    /// An operand.
    Operand(Operand),
    /// The result of a list.
    List(Vec<Statement>),
}

/// A call of a standard function.
#[derive(Clone, Debug)]
pub struct Standard {
    /// Which.
    pub function: StandardFunction,
    /// The type of its value.
    pub ty: TypeId,
    /// Its arguments in their order.
    pub arguments: Vec<Feed>,
    /// `EN` and `ENO`.
    pub enable: Enable,
}

/// The standard functions that are not operators as well (2.5.1.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StandardFunction {
    /// `X_TO_Y`
    Convert,
    /// `MOVE`
    Move,
    /// `NOT`
    Not,
    /// `ABS`
    Abs,
    /// `MIN`
    Min,
    /// `MAX`
    Max,
    /// `LIMIT(MN, IN, MX)`
    Limit,
    /// `SEL(G, IN0, IN1)`
    Sel,
    /// `MUX(K, IN0, …)`
    Mux,
    /// `ADD(IN1, IN2, …)`, `SHL(IN, N)`: CR function second, function third, ….
    Fold(Function),
    /// `GT(IN1, IN2, …)`: each compared with the next.
    Chain(Function),
}
