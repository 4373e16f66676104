//! What packed states say of atoms, in both views.

use super::bound::Valuation;
use crate::explore::{Markings, ScanSpace};
use crate::net::{PlaceId, TransitionId};
use crate::semantics::VarId;

/// A packed scan state. Formulas bound for the scan view speak of variables only.
pub struct ScanValuation<'a>(pub &'a ScanSpace<'a>, pub &'a [u64]);

impl Valuation for ScanValuation<'_> {
    fn value(&self, variable: VarId) -> u64 {
        self.0.value(self.1, variable)
    }

    fn is_marked(&self, _: PlaceId) -> bool {
        false
    }

    fn tokens(&self, _: PlaceId) -> u64 {
        0
    }

    fn is_enabled(&self, _: TransitionId) -> bool {
        false
    }

    fn is_deadlock(&self) -> bool {
        false
    }
}

/// A packed marking. Formulas bound for the transition view speak of places and transitions only.
pub struct MarkingValuation<'a>(pub &'a Markings<'a>, pub &'a [u64]);

impl Valuation for MarkingValuation<'_> {
    fn value(&self, _: VarId) -> u64 {
        0
    }

    fn is_marked(&self, place: PlaceId) -> bool {
        self.0.is_marked(self.1, place)
    }

    fn tokens(&self, place: PlaceId) -> u64 {
        u64::from(self.is_marked(place))
    }

    fn is_enabled(&self, transition: TransitionId) -> bool {
        self.0.is_enabled(self.1, transition)
    }

    fn is_deadlock(&self) -> bool {
        self.0.is_deadlock(self.1)
    }
}
