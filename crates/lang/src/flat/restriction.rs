//! Types of which not every pattern is a value.

use std::sync::Arc;

use super::{FlatProgram, value_text};
use crate::semantics::{Scalar, VarId};

/// What a declaration allows of a type's values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Restriction {
    /// The names of the values 0, 1, ….
    Enumeration(Arc<[String]>),
    /// The least and the greatest value.
    Subrange(i128, i128),
}

impl Restriction {
    /// What a scalar's declaration allows, if that is not every value of its type.
    #[must_use]
    pub fn of(scalar: &Scalar) -> Option<Self> {
        match (&scalar.enumeration, scalar.range) {
            (Some(enumeration), _) => Some(Self::Enumeration(enumeration.values.clone())),
            (None, Some((lower, upper))) => Some(Self::Subrange(lower, upper)),
            (None, None) => None,
        }
    }

    /// The least and the greatest value allowed.
    #[must_use]
    pub fn range(&self) -> (i128, i128) {
        match self {
            Self::Enumeration(names) => (0, names.len() as i128 - 1),
            Self::Subrange(lower, upper) => (*lower, *upper),
        }
    }
}

impl FlatProgram {
    /// The least and the greatest number a variable may be given from outside.
    #[must_use]
    pub fn range(&self, id: VarId) -> (i128, i128) {
        let ty = self.variable(id).ty;
        self.restrictions.get(&id).map_or((ty.least(), ty.greatest()), Restriction::range)
    }

    /// The number of a value's name, for a variable of an enumerated type.
    #[must_use]
    pub fn enumerated(&self, id: VarId, name: &str) -> Option<i128> {
        match self.restrictions.get(&id)? {
            Restriction::Enumeration(names) => {
                names.iter().position(|own| own.eq_ignore_ascii_case(name)).map(|number| number as i128)
            }
            Restriction::Subrange(..) => None,
        }
    }

    /// The value of a variable in a table; that of an enumerated type by its name.
    #[must_use]
    pub fn value_text(&self, id: VarId, pattern: u64) -> String {
        let named = match self.restrictions.get(&id) {
            Some(Restriction::Enumeration(names)) => usize::try_from(pattern).ok().and_then(|number| names.get(number)),
            _ => None,
        };
        named.cloned().unwrap_or_else(|| value_text(self.variable(id).ty, pattern))
    }
}
