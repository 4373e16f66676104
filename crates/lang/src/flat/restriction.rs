//! Restrictions of variables whose type has patterns that are not values: enumerations and subranges.

use std::sync::Arc;

use super::{FlatProgram, value_text};
use crate::semantics::{Scalar, VarId};

/// Restriction of a type's values by a declaration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Restriction {
    /// Enumeration: names of the values 0, 1, ….
    Enumeration(Arc<[String]>),
    /// Subrange: least and greatest value.
    Subrange(i128, i128),
}

impl Restriction {
    /// Restriction by a scalar's declaration; `None` if it allows every value of its type.
    #[must_use]
    pub fn of(scalar: &Scalar) -> Option<Self> {
        match (&scalar.enumeration, scalar.range) {
            (Some(enumeration), _) => Some(Self::Enumeration(enumeration.values.clone())),
            (None, Some((lower, upper))) => Some(Self::Subrange(lower, upper)),
            (None, None) => None,
        }
    }

    /// Least and greatest value allowed.
    #[must_use]
    pub fn range(&self) -> (i128, i128) {
        match self {
            Self::Enumeration(names) => (0, names.len() as i128 - 1),
            Self::Subrange(lower, upper) => (*lower, *upper),
        }
    }
}

impl FlatProgram {
    /// Least and greatest number that a variable may be given from outside.
    #[must_use]
    pub fn range(&self, id: VarId) -> (i128, i128) {
        let ty = self.variable(id).ty;
        self.restrictions.get(&id).map_or((ty.least(), ty.greatest()), Restriction::range)
    }

    /// Number of an enumerated value by its name, for a variable of an enumerated type.
    #[must_use]
    pub fn enumerated(&self, id: VarId, name: &str) -> Option<i128> {
        match self.restrictions.get(&id)? {
            Restriction::Enumeration(names) => {
                names.iter().position(|own| own.eq_ignore_ascii_case(name)).map(|number| number as i128)
            }
            Restriction::Subrange(..) => None,
        }
    }

    /// Text of a variable's value in a table; that of an enumerated type is its name.
    #[must_use]
    pub fn value_text(&self, id: VarId, pattern: u64) -> String {
        let named = match self.restrictions.get(&id) {
            Some(Restriction::Enumeration(names)) => usize::try_from(pattern).ok().and_then(|number| names.get(number)),
            _ => None,
        };
        named.cloned().unwrap_or_else(|| value_text(self.variable(id).ty, pattern))
    }
}
