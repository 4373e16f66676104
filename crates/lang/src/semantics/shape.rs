//! Types of variables: elementary ones, arrays and structures of them, and function blocks.

use std::collections::BTreeSet;
use std::fmt;
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

use petril_base::{Kind, Type};

/// Program organisation unit, a key of [`Program::pous`](super::Program::pous).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PouId(pub usize);

/// Shape of a variable: its type, resolved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Elementary value.
    Scalar(Scalar),
    /// `ARRAY [ranges] OF of`
    Array {
        /// Least and greatest index of each dimension.
        ranges: Vec<(i64, i64)>,
        /// Shape of the elements.
        of: Box<Shape>,
    },
    /// `STRUCT … END_STRUCT`
    Structure(Rc<Structure>),
    /// Instance of a function block.
    Instance(PouId),
}

/// Structure with its members.
#[derive(Debug, PartialEq, Eq)]
pub struct Structure {
    /// Name that the structure was declared by, if it has one.
    pub name: String,
    /// Members in the order of declaration.
    pub members: Vec<Member>,
    /// Number of elementary values, plus one for the structure: an empty structure takes a step to walk through, too.
    pub(super) leaves: usize,
    /// Nesting depth of the members.
    pub(super) depth: usize,
}

impl Structure {
    /// Creates a structure of these members.
    #[must_use]
    pub fn new(name: String, members: Vec<Member>) -> Self {
        let leaves = members.iter().fold(1_usize, |sum, member| sum.saturating_add(member.shape.leaves()));
        let depth = members.iter().map(|member| member.shape.depth()).max().unwrap_or(0) + 1;
        Self { name, members, leaves, depth }
    }
}

/// Member of a structure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// Name as it was declared.
    pub name: String,
    /// Shape of the member.
    pub shape: Shape,
    /// Value at power-on.
    pub initial: Value,
}

/// Elementary type with the restriction on its values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scalar {
    /// Elementary type; of an enumeration the least unsigned one that can distinguish its values.
    pub ty: Type,
    /// Least and greatest value of a subrange.
    pub range: Option<(i128, i128)>,
    /// Enumeration, if the type is one.
    pub enumeration: Option<Rc<Enumeration>>,
    /// Value at power-on if none is given, as a pattern.
    pub default: u64,
}

/// Enumerated type.
#[derive(Debug, PartialEq, Eq)]
pub struct Enumeration {
    /// Name that the type was declared by; of a type without a name, its values.
    pub name: String,
    /// Names of the values 0, 1, ….
    pub values: Arc<[String]>,
}

impl Enumeration {
    /// Number of a value by its name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<usize> {
        self.values.iter().position(|value| value.eq_ignore_ascii_case(name))
    }
}

/// Value at power-on, given for a shape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// Default of the type.
    Default,
    /// Pattern of an elementary value.
    Scalar(u64),
    /// Values of the members or elements at these positions; the others have the defaults of their types.
    Parts(Rc<[(Range<usize>, Value)]>),
}

impl Scalar {
    /// Creates a scalar of an elementary type.
    #[must_use]
    pub fn new(ty: Type) -> Self {
        Self { ty, range: None, enumeration: None, default: 0 }
    }

    /// Creates a scalar of an enumeration: a number from 0 for each of its values.
    #[must_use]
    pub fn enumerated(enumeration: Rc<Enumeration>) -> Self {
        let width = if enumeration.values.len() <= 1 << 8 { 8 } else { 16 };
        let range = Some((0, enumeration.values.len() as i128 - 1));
        Self { ty: Type::new(Kind::Unsigned, width), range, enumeration: Some(enumeration), default: 0 }
    }
}

impl Shape {
    /// Scalar, if the shape is one.
    #[must_use]
    pub fn scalar(&self) -> Option<&Scalar> {
        match self {
            Self::Scalar(scalar) => Some(scalar),
            _ => None,
        }
    }

    /// Number of elementary values, an instance counted as one.
    #[must_use]
    pub fn leaves(&self) -> usize {
        match self {
            Self::Scalar(_) | Self::Instance(_) => 1,
            Self::Array { ranges, of } => elements(ranges).saturating_mul(of.leaves()),
            Self::Structure(structure) => structure.leaves,
        }
    }

    /// Function blocks that the shape holds instances of.
    #[must_use]
    pub fn instances(&self) -> BTreeSet<PouId> {
        match self {
            Self::Scalar(_) => BTreeSet::new(),
            Self::Array { of, .. } => of.instances(),
            Self::Structure(structure) => {
                structure.members.iter().flat_map(|member| member.shape.instances()).collect()
            }
            Self::Instance(id) => BTreeSet::from([*id]),
        }
    }

    /// Nesting depth of arrays and structures.
    #[must_use]
    pub fn depth(&self) -> usize {
        match self {
            Self::Scalar(_) | Self::Instance(_) => 0,
            Self::Array { of, .. } => of.depth() + 1,
            Self::Structure(structure) => structure.depth,
        }
    }

    /// Whether a variable of the other shape may stand for one of this shape: their types are equal everywhere.
    #[must_use]
    pub fn same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Scalar(a), Self::Scalar(b)) => (a.ty, &a.range, &a.enumeration) == (b.ty, &b.range, &b.enumeration),
            (Self::Array { ranges, of }, Self::Array { ranges: others, of: other }) => {
                ranges == others && of.same(other)
            }
            (Self::Structure(a), Self::Structure(b)) => Rc::ptr_eq(a, b),
            (Self::Instance(a), Self::Instance(b)) => a == b,
            _ => false,
        }
    }
}

/// Number of elements of an array with these ranges.
#[must_use]
pub fn elements(ranges: &[(i64, i64)]) -> usize {
    ranges.iter().map(|&(lower, upper)| (upper - lower + 1) as usize).product()
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scalar(scalar) => scalar.fmt(f),
            Self::Array { ranges, of } => {
                let ranges: Vec<String> = ranges.iter().map(|(lower, upper)| format!("{lower}..{upper}")).collect();
                write!(f, "ARRAY [{}] OF {of}", ranges.join(", "))
            }
            Self::Structure(structure) => f.write_str(&structure.name),
            Self::Instance(_) => f.write_str("a function block"),
        }
    }
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.enumeration, self.range) {
            (Some(enumeration), _) => f.write_str(&enumeration.name),
            (None, Some((lower, upper))) => write!(f, "{} ({lower}..{upper})", self.ty),
            (None, None) => self.ty.fmt(f),
        }
    }
}
