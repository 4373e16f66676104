//! Checked program: names resolved to variables, labels to positions, every value typed.

use std::collections::BTreeMap;

use super::address::Area;
use super::function::Function;
use super::shape::{PouId, Scalar, Shape, Value};
use super::symbols::Section;
pub use crate::syntax::ast::{Condition, PouKind};
use petril_base::Type;
use petril_base::source::Span;

/// Program that satisfies every static rule, with all it calls.
#[derive(Clone, Debug)]
pub struct Program {
    /// Units that the program needs.
    pub pous: BTreeMap<PouId, Pou>,
    /// Unit that is executed once in every scan.
    pub entry: PouId,
    /// Global variables.
    pub globals: Vec<Variable>,
    /// Scan time in milliseconds, if a task gives it.
    pub interval: Option<u64>,
}

/// Program organisation unit.
#[derive(Clone, Debug)]
pub struct Pou {
    /// Name of the unit.
    pub name: String,
    /// Kind of the unit.
    pub kind: PouKind,
    /// Whether the unit is one of the standard's, which have no text in the user's file.
    pub is_library: bool,
    /// Variables in the order of declaration.
    pub variables: Vec<Variable>,
    /// Instructions in their order.
    pub body: Vec<Statement>,
    /// Type of each [`TypeId`] of the body.
    pub types: Vec<Type>,
    /// Value of each [`Operand::Literal`] of the body, as a pattern.
    pub literals: Vec<u64>,
}

/// Variable of a unit.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Name as it was declared.
    pub name: String,
    /// Section that declares the variable.
    pub section: Section,
    /// Shape: an elementary type, an array, a structure or an instance.
    pub shape: Shape,
    /// Initial value, at power-on or at each call.
    pub initial: Value,
    /// Area of the address.
    pub area: Option<Area>,
    /// Address in its normalised spelling.
    pub address: Option<String>,
    /// Span of the declaration.
    pub span: Span,
}

/// Role of a variable of flat code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// `VAR_INPUT`: set by the plant before every scan.
    Input,
    /// `VAR`: keeps its value from scan to scan.
    Memory,
    /// `VAR_OUTPUT`: read by the plant after every scan; keeps its value too.
    Output,
    /// `CONSTANT`: never changes.
    Constant,
    /// Temporary value, like that of a parenthesis or of a function's variable; nothing of it survives the scan.
    Buffer,
}

/// Type, as a position in [`Pou::types`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TypeId(pub usize);

/// Instruction with its span.
#[derive(Clone, Debug)]
pub struct Statement {
    /// Action of the instruction.
    pub action: Action,
    /// Span of the instruction; for a parenthesis of its first line.
    pub span: Span,
}

/// Action of an instruction: its effect on the memory and the current result (CR).
#[derive(Clone, Debug)]
pub enum Action {
    /// `LD`, `LDN`
    Load {
        /// Type of operand and CR.
        ty: TypeId,
        /// Whether modifier N is set.
        negated: bool,
        /// Operand loaded.
        operand: Operand,
    },
    /// `ST`, `STN`
    Store {
        /// Type of place and CR.
        ty: TypeId,
        /// Whether modifier N is set.
        negated: bool,
        /// Variable or part of one that is written.
        place: Place,
    },
    /// `S`
    Set(Place),
    /// `R`
    Reset(Place),
    /// `NOT`
    Complement(TypeId),
    /// Operator with its operand.
    Combine {
        /// Function applied.
        function: Function,
        /// Type of CR and operand.
        ty: TypeId,
        /// Whether modifier N is set.
        negated: bool,
        /// Right operand.
        operand: Operand,
    },
    /// Operator deferred to the end of a parenthesis.
    Defer {
        /// Function applied.
        function: Function,
        /// Type of CR and of the value of the parenthesis.
        ty: TypeId,
        /// Whether modifier N is set: the value of the parenthesis is complemented.
        negated: bool,
        /// Instructions inside the parenthesis.
        body: Vec<Statement>,
        /// Span of the closing parenthesis.
        close: Span,
    },
    /// `JMP…`: jump to this position of the unit's body, whose length stands for the end.
    Jump(Condition, usize),
    /// `RET…`
    Return(Condition),
    /// Call of a function block or of a function of the file.
    Call(Box<Call>),
    /// Call of a standard function.
    Standard(Box<Standard>),
}

/// Operand: a variable or a literal.
#[derive(Clone, Debug)]
pub enum Operand {
    /// Variable or a part of one.
    Place(Place),
    /// Literal, as a position in [`Pou::literals`].
    Literal(usize),
}

/// Variable or a part of one.
#[derive(Clone, Debug)]
pub struct Place {
    /// Variable that the place is part of.
    pub root: Root,
    /// Steps from the variable to the part.
    pub steps: Vec<Step>,
    /// Shape of the part.
    pub shape: Shape,
    /// Span of the path in the text.
    pub span: Span,
}

impl Place {
    /// Scalar of an elementary place; others have been refused where only elementary ones may stand.
    #[must_use]
    pub fn scalar(&self) -> Scalar {
        self.shape.scalar().cloned().unwrap_or_else(|| Scalar::new(Type::BOOL))
    }
}

/// Variable at the root of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Root {
    /// Variable of the unit, by position.
    Own(usize),
    /// Global variable, by position.
    Global(usize),
}

/// Step from a variable to a part of it.
#[derive(Clone, Debug)]
pub enum Step {
    /// Member of a structure, or variable of a function block, at this position.
    Member(usize),
    /// Element with these indices, one for each range.
    Index(Vec<Index>),
}

/// Index of an array.
#[derive(Clone, Debug)]
pub enum Index {
    /// Number, inside its range.
    Constant(i64),
    /// Elementary variable.
    Variable(Place),
}

/// Call of a function block or a function of the file.
#[derive(Clone, Debug)]
pub struct Call {
    /// Condition of the call; parameters are passed only if it holds.
    pub condition: Condition,
    /// Called unit.
    pub callee: Callee,
    /// Variable of the callee that CR is stored in first, and its type.
    pub result_to: Option<(usize, TypeId)>,
    /// Values for inputs of the callee (by the position of the variable), in the order of the text.
    pub inputs: Vec<(usize, Feed)>,
    /// Variables of the caller bound to the in-out variables of the callee.
    pub in_outs: Vec<(usize, Place)>,
    /// Variables of the caller that receive outputs, in the order of the text; complemented if `true`.
    pub outputs: Vec<(usize, bool, Place)>,
    /// `EN` and `ENO`.
    pub enable: Enable,
    /// Number of outputs that are written before `ENO`.
    pub before_eno: usize,
}

/// Called unit.
#[derive(Clone, Debug)]
pub enum Callee {
    /// Instance of a function block.
    Instance(PouId, Place),
    /// Function.
    Function(PouId),
}

/// Parameters `EN` and `ENO` of a call (2.5.1.2).
#[derive(Clone, Debug, Default)]
pub struct Enable {
    /// `EN`: whether the call is executed.
    pub en: Option<Feed>,
    /// `ENO`: variable that receives whether the call was executed; complemented if `true`.
    pub eno: Option<(bool, Place)>,
}

/// Value passed to an input, with its type.
#[derive(Clone, Debug)]
pub struct Feed {
    /// Type of the value.
    pub ty: TypeId,
    /// Source of the value.
    pub source: FeedSource,
    /// Span in the text.
    pub span: Span,
}

/// Source of a value passed to an input.
#[derive(Clone, Debug)]
pub enum FeedSource {
    /// Current result.
    Result,
    /// Operand.
    Operand(Operand),
    /// Current result at the end of a list.
    List(Vec<Statement>),
}

/// Call of a standard function.
#[derive(Clone, Debug)]
pub struct Standard {
    /// Function called.
    pub function: StandardFunction,
    /// Type of the value of the function.
    pub ty: TypeId,
    /// Arguments in the order of the function's inputs.
    pub arguments: Vec<Feed>,
    /// `EN` and `ENO`.
    pub enable: Enable,
}

/// Standard function that is not an operator as well (2.5.1.5).
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
