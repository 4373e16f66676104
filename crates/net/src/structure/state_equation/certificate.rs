//! Proofs, in integers, that no reachable marking satisfies some constraints. Verifying one needs only the net and the
//! constraints; the code that verifies has no part in finding them.

use super::{Constraint, Relation};
use crate::net::{Net, PlaceId};

/// Certificate of a contradiction between constraints and the state equation.
///
/// The constraints, with multipliers, imply that a weighted sum of tokens is at least a number. With non-negative
/// multiples of tokens added, no firing increases the sum, and its initial value is less than that number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Certificate {
    /// Multiplier of each constraint: not negative for [`Relation::AtLeast`], not positive for [`Relation::AtMost`].
    pub constraints: Vec<i128>,
    /// Positive multiples of the tokens of places that are added.
    pub places: Vec<(PlaceId, i128)>,
}

impl Certificate {
    /// Whether the certificate proves that no reachable marking of the net satisfies all of the constraints. Numbers
    /// too large for exact arithmetic prove nothing.
    #[must_use]
    pub fn verify(&self, net: &Net, constraints: &[Constraint]) -> bool {
        self.constraints.len() == constraints.len() && self.contradicts(net, constraints).unwrap_or(false)
    }

    fn contradicts(&self, net: &Net, constraints: &[Constraint]) -> Option<bool> {
        let mut weights = vec![0_i128; net.places().len()];
        let mut least = 0_i128;
        for (&times, constraint) in self.constraints.iter().zip(constraints) {
            let fits = match constraint.relation {
                Relation::AtLeast => times >= 0,
                Relation::AtMost => times <= 0,
                Relation::Equal => true,
            };
            if !fits {
                return Some(false);
            }
            for &(place, coefficient) in &constraint.terms {
                let weight = weights.get_mut(place.index())?;
                *weight = weight.checked_add(times.checked_mul(i128::from(coefficient))?)?;
            }
            least = least.checked_add(times.checked_mul(i128::from(constraint.value))?)?;
        }
        for &(place, times) in &self.places {
            let weight = weights.get_mut(place.index())?;
            *weight = weight.checked_add(times)?;
            if times < 0 {
                return Some(false);
            }
        }
        Some(never_increases(net, &weights)? && initially(net, &weights)? < least)
    }
}

/// Whether no firing increases a weighted sum of tokens.
pub(super) fn never_increases(net: &Net, weights: &[i128]) -> Option<bool> {
    for id in net.transition_ids() {
        let mut change = 0_i128;
        for (place, weight) in net.put(id) {
            change = change.checked_add(weights[place.index()].checked_mul(i128::from(weight))?)?;
        }
        for (place, weight) in net.taken(id) {
            change = change.checked_sub(weights[place.index()].checked_mul(i128::from(weight))?)?;
        }
        if change > 0 {
            return Some(false);
        }
    }
    Some(true)
}

/// Weighted sum of the tokens in the initial marking.
pub(super) fn initially(net: &Net, weights: &[i128]) -> Option<i128> {
    net.places()
        .zip(weights)
        .try_fold(0_i128, |sum, (place, &weight)| sum.checked_add(weight.checked_mul(i128::from(place.tokens))?))
}
