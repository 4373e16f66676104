//! Place invariants (weighted sums of tokens that no firing changes) and transition invariants (firings that together
//! change nothing).

use super::incidence::Incidence;
use super::kernel::{Kernel, kernel};
use super::semiflows::{Limits, Row, Wanted, semiflows};
use crate::net::{Net, PlaceId, TransitionId};

/// A place invariant: places with weights, ascending, whose weighted sum of tokens is `tokens` in every reachable marking.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct PlaceInvariant {
    /// Places with positive weights.
    pub weights: Vec<(PlaceId, u64)>,
    /// The weighted sum of tokens.
    pub tokens: u64,
}

/// A transition invariant: transitions, ascending, with numbers of firings that together restore the marking. An order
/// in which they can fire need not exist.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TransitionInvariant {
    /// Transitions with positive numbers of firings.
    pub firings: Vec<(TransitionId, u64)>,
}

/// Result of a search for invariants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Invariants<I> {
    /// Invariants found, in ascending order.
    pub found: Vec<I>,
    /// Whether `found` is complete: all semi-positive invariants of minimal support. If not, a limit ended the search,
    /// and the support of some of those found may not be minimal.
    pub all: bool,
}

/// Computes the semi-positive place invariants (P-semiflows) of minimal support.
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

/// Computes the semi-positive transition invariants (T-semiflows) of minimal support.
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

/// Computes a basis of all place invariants over the rationals, negative weights included, and the rank of the
/// incidence matrix. `None` if more than `steps` elementary steps are needed.
#[must_use]
pub fn place_basis(net: &Net, incidence: &Incidence, steps: u64) -> Option<Kernel> {
    kernel(net.place_ids().map(|id| incidence.of_place(id).to_vec()), net.transitions().len(), steps)
}

/// Computes a basis of all transition invariants, like [`place_basis`].
#[must_use]
pub fn transition_basis(net: &Net, incidence: &Incidence, steps: u64) -> Option<Kernel> {
    kernel(net.transition_ids().map(|id| incidence.of_transition(id).to_vec()), net.places().len(), steps)
}

/// Solves for semiflows. Rows with entries beyond 64 bits are left out.
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
