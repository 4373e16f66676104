//! Declarations of variables and data types (B.1.3.3, B.1.4.3).

use std::fmt;

use super::{Constant, Name, Path};
use petril_base::source::Span;

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

/// One block from `VAR…` to `END_VAR`.
#[derive(Clone, Debug)]
pub struct VarBlock {
    /// Which kind of variables it declares.
    pub kind: VarKind,
    /// `CONSTANT` was written.
    pub constant: bool,
    /// `RETAIN`, `NON_RETAIN` or `PERSISTENT`, as written.
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
    /// The type; `None` if the declaration could not be read, which has been reported.
    pub spec: Option<TypeSpec>,
    /// `R_EDGE` or `F_EDGE` behind the type.
    pub edge: Option<Name>,
    /// The initial value.
    pub initial: Option<Initial>,
}

/// `TYPE name : spec := initial; END_TYPE`
#[derive(Clone, Debug)]
pub struct TypeDeclaration {
    /// Its name.
    pub name: Name,
    /// What it stands for; `None` if it could not be read, which has been reported.
    pub spec: Option<TypeSpec>,
    /// The initial value of variables of the type.
    pub initial: Option<Initial>,
}

/// A type where a variable or type is declared.
#[derive(Clone, Debug)]
pub enum TypeSpec {
    /// `INT`, `TON`, `STRING[20]`: a name, or the text of a type that has none.
    Named(Name),
    /// `INT (0..100)`
    Subrange {
        /// The type it is part of.
        base: Name,
        /// Its least and greatest value.
        range: Range,
    },
    /// `(Idle, Filling, Done)`
    Enumeration(Vec<Name>),
    /// `ARRAY [0..9, 1..3] OF INT`
    Array {
        /// One range for each dimension.
        ranges: Vec<Range>,
        /// The type of the elements.
        of: Box<TypeSpec>,
        /// The whole.
        span: Span,
    },
    /// `STRUCT … END_STRUCT`
    Structure {
        /// The members.
        members: Vec<Declaration>,
        /// Where its first word stands.
        span: Span,
    },
}

impl TypeSpec {
    /// Where it stands.
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

/// An initial value.
#[derive(Clone, Debug)]
pub struct Initial {
    /// What is given.
    pub kind: InitialKind,
    /// Where it stands.
    pub span: Span,
}

/// The forms of an initial value.
#[derive(Clone, Debug)]
pub enum InitialKind {
    /// A literal.
    Constant(Constant),
    /// An enumerated value or the name of a constant.
    Name(Path),
    /// `[1, 2, 3(0)]`: values with how often each comes.
    List(Vec<(u64, Initial)>),
    /// `(a := 1, b := 2)`
    Structure(Vec<(Name, Initial)>),
}
