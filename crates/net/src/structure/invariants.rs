//! Invariants: sums of places that no firing changes, and firings that together change nothing.

use super::incidence::Incidence;
use super::kernel::{Kernel, kernel};
use super::semiflows::{Limits, Row, Wanted, semiflows};
use crate::net::{Net, PlaceId, TransitionId};

/// A place invariant: places with weights, ascending, whose weighted sum of tokens is `tokens` in every reachable marking.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct PlaceInvariant {
    /// The places it weighs, each at least once.
    pub weights: Vec<(PlaceId, u64)>,
    /// The sum.
    pub tokens: u64,
}

/// A transition invariant: how often each of some transitions, ascending, must fire so that the marking is as it was before.
/// It says nothing of an order in which they can fire.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TransitionInvariant {
    /// The transitions that fire, each at least once.
    pub firings: Vec<(TransitionId, u64)>,
}

/// The invariants found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Invariants<I> {
    /// In ascending order.
    pub found: Vec<I>,
    /// Whether these are all semi-positive invariants of minimal support. If not, a limit ended the search, and the support of
    /// some that were found may not be minimal.
    pub all: bool,
}

/// The semi-positive place invariants of minimal support.
#[must_use]
pub fn place_invariants(net: &Net, incidence: &Incidence, limits: Limits) -> Invariants<PlaceInvariant> {
    let rows = net.place_ids().map(|id| (id.index(), net.place(id).tokens, incidence.of_place(id)));
    let (rows, all) = solutions(rows, net.transitions().len(), limits);
    let invariant = |row: Row| {
        let weights = row.weights.into_iter().map(|(place, weight)| (PlaceId::at(place), weight));
        PlaceInvariant { weights: weights.collect(), tokens: row.tokens }
    };
    let mut found: Vec<PlaceInvariant> = rows.into_iter().map(invariant).collect();
    found.sort_unstable();
    Invariants { found, all }
}

/// The semi-positive transition invariants of minimal support.
#[must_use]
pub fn transition_invariants(net: &Net, incidence: &Incidence, limits: Limits) -> Invariants<TransitionInvariant> {
    let rows = net.transition_ids().map(|id| (id.index(), 0, incidence.of_transition(id)));
    let (rows, all) = solutions(rows, net.places().len(), limits);
    let invariant = |row: Row| {
        let firings = row.weights.into_iter().map(|(transition, times)| (TransitionId::at(transition), times));
        TransitionInvariant { firings: firings.collect() }
    };
    let mut found: Vec<TransitionInvariant> = rows.into_iter().map(invariant).collect();
    found.sort_unstable();
    Invariants { found, all }
}

/// A basis of all place invariants, also those with negative weights, over the fractions; and the rank of the incidence
/// matrix. Nothing if it takes more than so many elementary steps.
#[must_use]
pub fn place_basis(net: &Net, incidence: &Incidence, steps: u64) -> Option<Kernel> {
    kernel(net.place_ids().map(|id| incidence.of_place(id).to_vec()), net.transitions().len(), steps)
}

/// A basis of all transition invariants, like [`place_basis`].
#[must_use]
pub fn transition_basis(net: &Net, incidence: &Incidence, steps: u64) -> Option<Kernel> {
    kernel(net.transition_ids().map(|id| incidence.of_transition(id).to_vec()), net.places().len(), steps)
}

/// Rows that cannot be computed with are left out.
fn solutions<'i>(
    rows: impl Iterator<Item = (usize, u64, &'i [(u32, i128)])>,
    columns: usize,
    limits: Limits,
) -> (Vec<Row>, bool) {
    let mut fit = true;
    let rows = rows.map(|(position, tokens, changes)| {
        let changes: Result<Vec<(u32, i64)>, _> =
            changes.iter().map(|&(column, change)| i64::try_from(change).map(|change| (column, change))).collect();
        fit &= changes.is_ok();
        changes.ok().map(|changes| Row::of(position, tokens, changes))
    });
    let rows: Vec<Option<Row>> = rows.collect();
    let count = rows.len();
    let found = semiflows(rows.into_iter().flatten().collect(), count, columns, Wanted::Any, limits);
    (found.rows, found.all && fit)
}
