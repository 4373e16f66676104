//! Place invariants of a net, for the encoding of markings.

use super::model::Rule;
pub(super) use crate::structure::semiflows::Wanted;
use crate::structure::semiflows::{Limits, Row, semiflows};

/// Place invariant: places with weights, ascending, whose weighted sum of tokens is `tokens` in every reachable
/// marking.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Invariant {
    pub(super) weights: Vec<(usize, u64)>,
    pub(super) tokens: u64,
}

/// Computes minimal invariants of a net, possibly not all.
pub(super) fn invariants(initial: &[u64], rules: &[Rule], wanted: Wanted) -> Vec<Invariant> {
    let mut changes: Vec<Vec<(u32, i64)>> = vec![Vec::new(); initial.len()];
    for (transition, rule) in rules.iter().enumerate() {
        for touch in rule.iter().filter(|touch| touch.change() != 0) {
            changes[touch.place].push((transition as u32, touch.change()));
        }
    }
    let rows =
        changes.into_iter().enumerate().map(|(place, changes)| Row::of(place, initial[place], changes)).collect();
    let found = semiflows(rows, initial.len(), rules.len(), wanted, Limits::default());
    found.rows.into_iter().map(|row| Invariant { weights: row.weights, tokens: row.tokens }).collect()
}
