//! Linear constraints on markings.

use crate::net::{PlaceId, Tokens};

/// Relation between a sum and a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Relation {
    /// At least the value.
    AtLeast,
    /// At most the value.
    AtMost,
    /// Equal to the value.
    Equal,
}

/// Linear constraint: a sum of tokens with coefficients, compared with a value.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Constraint {
    /// Places with their coefficients. Coefficients of a place that occurs several times add up.
    pub terms: Vec<(PlaceId, i64)>,
    /// Relation between the sum and `value`.
    pub relation: Relation,
    /// Right-hand side.
    pub value: i64,
}

impl Constraint {
    /// Whether a marking satisfies the constraint.
    #[must_use]
    pub fn is_satisfied(&self, tokens: &Tokens) -> bool {
        let sum = self
            .terms
            .iter()
            .try_fold(0_i128, |sum, &(place, times)| sum.checked_add(i128::from(times) * i128::from(tokens.on(place))));
        let value = i128::from(self.value);
        sum.is_some_and(|sum| match self.relation {
            Relation::AtLeast => sum >= value,
            Relation::AtMost => sum <= value,
            Relation::Equal => sum == value,
        })
    }
}
