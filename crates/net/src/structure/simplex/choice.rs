//! Pivoting rules: the leaving row and the entering variable.

use super::TOLERANCE;

/// Magnitude below which an entry is too small to divide by.
const SMALL: f64 = 1e-7;

/// Chooses the leaving row by dual steepest edge: the negative value that is largest relative to the norm of its row of
/// the inverse.
pub fn row(values: &[f64], lengths: &[f64]) -> Option<usize> {
    let mut best = None;
    let mut most = 0.0;
    for (row, &value) in values.iter().enumerate() {
        if value < -TOLERANCE {
            let gain = value * value / lengths[row];
            if gain > most {
                (best, most) = (Some(row), gain);
            }
        }
    }
    best
}

/// Chooses the entering variable among (variable, entry in the row, reduced cost) by Harris's ratio test (1973): no
/// reduced cost becomes negative by more than a tolerance, which is used to find a large entry.
pub fn column(candidates: impl Iterator<Item = (usize, f64, f64)> + Clone) -> Option<usize> {
    let fitting = candidates.filter(|&(_, entry, _)| entry < -SMALL);
    let bound = |(_, entry, cost): (usize, f64, f64)| (cost.max(0.0) + TOLERANCE * 0.01) / -entry;
    let most = fitting.clone().map(bound).min_by(f64::total_cmp)?;
    let near = fitting.filter(|&(_, entry, cost)| cost.max(0.0) / -entry <= most);
    near.min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0))).map(|(variable, ..)| variable)
}
