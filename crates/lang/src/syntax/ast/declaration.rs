//! Declarations of variables and data types (B.1.3.3, B.1.4.3).

use std::fmt;

use super::{Constant, Name, Path};
use petril_base::source::Span;

/// Kinds of declaration block (B.1.4.3, B.1.5).
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
    /// `VAR_ACCESS`, `VAR_CONFIG`
    Access,
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
            Self::Access => "VAR_ACCESS",
        })
    }
}

/// Declaration block, from `VAR…` to `END_VAR`.
#[derive(Clone, Debug)]
pub struct VarBlock {
    /// Kind of the declared variables.
    pub kind: VarKind,
    /// Whether `CONSTANT` was written.
    pub constant: bool,
    /// `RETAIN`, `NON_RETAIN` or `PERSISTENT`, as written.
    pub retain: Option<Name>,
    /// Declarations in the order of the text.
    pub declarations: Vec<Declaration>,
    /// Span of the first word.
    pub span: Span,
}

/// Declaration: `a, b : BOOL := TRUE;`.
#[derive(Clone, Debug)]
pub struct Declaration {
    /// The declared names.
    pub names: Vec<Name>,
    /// Directly represented location after `AT`.
    pub location: Option<Name>,
    /// The type; `None` if the declaration could not be read, which has been reported.
    pub spec: Option<TypeSpec>,
    /// `R_EDGE` or `F_EDGE` after the type.
    pub edge: Option<Name>,
    /// The initial value.
    pub initial: Option<Initial>,
}

/// `TYPE name : spec := initial; END_TYPE`
#[derive(Clone, Debug)]
pub struct TypeDeclaration {
    /// Name of the type.
    pub name: Name,
    /// Type that the name stands for; `None` if it could not be read, which has been reported.
    pub spec: Option<TypeSpec>,
    /// The initial value of variables of the type.
    pub initial: Option<Initial>,
}

/// Type in the declaration of a variable or type.
#[derive(Clone, Debug)]
pub enum TypeSpec {
    /// `INT`, `TON`, `STRING[20]`: a name, or the text of a type that has none.
    Named(Name),
    /// `INT (0..100)`
    Subrange {
        /// Type that the subrange is part of.
        base: Name,
        /// Least and greatest value.
        range: Range,
    },
    /// `(Idle, Filling, Done)`
    Enumeration(Vec<Name>),
    /// `ARRAY [0..9, 1..3] OF INT`
    Array {
        /// Index ranges, one for each dimension.
        ranges: Vec<Range>,
        /// The type of the elements.
        of: Box<TypeSpec>,
        /// Span of the whole type.
        span: Span,
    },
    /// `STRUCT … END_STRUCT`
    Structure {
        /// The members.
        members: Vec<Declaration>,
        /// Span of the first word.
        span: Span,
    },
}

impl TypeSpec {
    /// Span of the type in the text.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Named(name) | Self::Subrange { base: name, .. } => name.span,
            Self::Enumeration(values) => values.first().map_or(Span::default(), |name| name.span),
            Self::Array { span, .. } | Self::Structure { span, .. } => *span,
        }
    }
}

/// `0..9`: literals or names of constants.
#[derive(Clone, Debug)]
pub struct Range {
    /// The least value.
    pub lower: Name,
    /// The greatest value.
    pub upper: Name,
}

/// Initial value.
#[derive(Clone, Debug)]
pub struct Initial {
    /// Form and parts of the value.
    pub kind: InitialKind,
    /// Span in the text.
    pub span: Span,
}

/// Forms of an initial value.
#[derive(Clone, Debug)]
pub enum InitialKind {
    /// A literal.
    Constant(Constant),
    /// An enumerated value or the name of a constant.
    Name(Path),
    /// `[1, 2, 3(0)]`: values, each with its repetition count.
    List(Vec<(u64, Initial)>),
    /// `(a := 1, b := 2)`
    Structure(Vec<(Name, Initial)>),
}
