//! The types of variables: elementary ones, what is made of them, and function blocks.

use std::collections::BTreeSet;
use std::fmt;
use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

use petril_base::{Kind, Type};

/// A program organisation unit, a key of [`Program::pous`](super::Program::pous).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PouId(pub usize);

/// What a variable is made of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One value.
    Scalar(Scalar),
    /// `ARRAY [ranges] OF of`
    Array {
        /// The least and greatest index of each dimension.
        ranges: Vec<(i64, i64)>,
        /// What the elements are.
        of: Box<Shape>,
    },
    /// `STRUCT … END_STRUCT`
    Structure(Rc<Structure>),
    /// An instance of a function block.
    Instance(PouId),
}

/// A structure's members.
#[derive(Debug, PartialEq, Eq)]
pub struct Structure {
    /// The name it was declared by, if it has one.
    pub name: String,
    /// In the order of declaration.
    pub members: Vec<Member>,
    /// How many elementary values it has, itself counted as one: a structure of nothing is something to walk through.
    pub(super) leaves: usize,
    /// How deeply its members are nested.
    pub(super) depth: usize,
}

impl Structure {
    /// A structure of these members.
    #[must_use]
    pub fn new(name: String, members: Vec<Member>) -> Self {
        let leaves = members.iter().fold(1_usize, |sum, member| sum.saturating_add(member.shape.leaves()));
        let depth = members.iter().map(|member| member.shape.depth()).max().unwrap_or(0) + 1;
        Self { name, members, leaves, depth }
    }
}

/// A member of a structure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// Its name as it was declared.
    pub name: String,
    /// What it is.
    pub shape: Shape,
    /// Its value at power-on.
    pub initial: Value,
}

/// An elementary type and what is allowed of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scalar {
    /// The elementary type; of an enumeration the least unsigned one that can tell its values apart.
    pub ty: Type,
    /// The least and greatest value of a subrange.
    pub range: Option<(i128, i128)>,
    /// The enumeration, if it is one.
    pub enumeration: Option<Rc<Enumeration>>,
    /// Its value at power-on if none is given, as a pattern.
    pub default: u64,
}

/// An enumerated type.
#[derive(Debug, PartialEq, Eq)]
pub struct Enumeration {
    /// The name it was declared by; of one without a name, its values.
    pub name: String,
    /// The names of its values 0, 1, ….
    pub values: Arc<[String]>,
}

impl Enumeration {
    /// The number of a value's name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<usize> {
        self.values.iter().position(|value| value.eq_ignore_ascii_case(name))
    }
}

/// A value at power-on, given for a shape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// What the type says.
    Default,
    /// The pattern of an elementary value.
    Scalar(u64),
    /// Values of the members or elements with these positions; the others have what their types say.
    Parts(Rc<[(Range<usize>, Value)]>),
}

impl Scalar {
    /// A scalar of an elementary type.
    #[must_use]
    pub fn new(ty: Type) -> Self {
        Self { ty, range: None, enumeration: None, default: 0 }
    }

    /// A scalar of an enumeration: a number from 0 for each of its values.
    #[must_use]
    pub fn enumerated(enumeration: Rc<Enumeration>) -> Self {
        let width = if enumeration.values.len() <= 1 << 8 { 8 } else { 16 };
        let range = Some((0, enumeration.values.len() as i128 - 1));
        Self { ty: Type::new(Kind::Unsigned, width), range, enumeration: Some(enumeration), default: 0 }
    }
}

impl Shape {
    /// The scalar, if it is one.
    #[must_use]
    pub fn scalar(&self) -> Option<&Scalar> {
        match self {
            Self::Scalar(scalar) => Some(scalar),
            _ => None,
        }
    }

    /// How many elementary values it has, an instance counted as one.
    #[must_use]
    pub fn leaves(&self) -> usize {
        match self {
            Self::Scalar(_) | Self::Instance(_) => 1,
            Self::Array { ranges, of } => elements(ranges).saturating_mul(of.leaves()),
            Self::Structure(structure) => structure.leaves,
        }
    }

    /// The function blocks that it holds instances of.
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

    /// How deeply arrays and structures are nested in it.
    #[must_use]
    pub fn depth(&self) -> usize {
        match self {
            Self::Scalar(_) | Self::Instance(_) => 0,
            Self::Array { of, .. } => of.depth() + 1,
            Self::Structure(structure) => structure.depth,
        }
    }

    /// Whether a variable of the other shape may stand for one of this: the same types everywhere.
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

/// How many elements an array of these ranges has.
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
