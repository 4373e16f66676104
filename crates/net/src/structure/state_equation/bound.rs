//! Upper bounds on sums of tokens, with proof.

use super::certificate::{initially, never_increases};
use crate::net::{Net, PlaceId};

/// An upper bound on the total number of tokens of some places.
///
/// The proof is a weighted sum that no firing increases, in which each of the places has a weight of at least `unit`:
/// in every reachable marking they have at most as many tokens as the initial value of the sum divided by `unit`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bound {
    /// Upper bound on the number of tokens.
    pub most: u64,
    /// Weights of the sum: places, ascending, with their weights.
    pub weights: Vec<(PlaceId, i128)>,
    /// Minimum weight of one of the places, for each time it is listed.
    pub unit: i128,
}

impl Bound {
    /// Whether the proof is valid: the places, each counted as often as it is listed, never have more than `most`
    /// tokens.
    #[must_use]
    pub fn verify(&self, net: &Net, places: &[PlaceId]) -> bool {
        self.value(net, places) == Some(self.most)
    }

    /// Bound that the weights prove, if they prove one.
    pub(super) fn value(&self, net: &Net, places: &[PlaceId]) -> Option<u64> {
        let mut weights = vec![0_i128; net.places().len()];
        for &(place, weight) in &self.weights {
            *weights.get_mut(place.index())? = weight;
        }
        let mut rest = weights.clone();
        for place in places {
            let rest = rest.get_mut(place.index())?;
            *rest = rest.checked_sub(self.unit)?;
        }
        if self.unit <= 0 || rest.iter().any(|&rest| rest < 0) || !never_increases(net, &weights)? {
            return None;
        }
        u64::try_from(initially(net, &weights)? / self.unit).ok()
    }
}
