//! How many tokens places have together at most, with the proof.

use super::certificate::{initially, never_increases};
use crate::net::{Net, PlaceId};

/// An upper bound on the tokens of some places together.
///
/// The proof is a weighted sum that no firing increases, in which each of the places counts at least `unit` times: in no
/// reachable marking do they have more tokens than the sum initially is worth, divided by `unit`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bound {
    /// They never have more tokens than this.
    pub most: u64,
    /// Places with weights, ascending.
    pub weights: Vec<(PlaceId, i128)>,
    /// What one of the tokens counts at least.
    pub unit: i128,
}

impl Bound {
    /// Whether this proves that the places, each as often as it is listed, never have more than `most` tokens together.
    #[must_use]
    pub fn verify(&self, net: &Net, places: &[PlaceId]) -> bool {
        self.value(net, places) == Some(self.most)
    }

    /// What the proof proves.
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
