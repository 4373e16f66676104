//! Which row is mended, and which variable enters the basis for it.

use super::TOLERANCE;

/// Entries that are too small to divide by.
const SMALL: f64 = 1e-7;

/// The row whose value is negative and farthest from 0, measured by the lengths of the rows of the inverse: dual steepest edge.
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

/// The variable that may enter: of (variable, entry in the row, reduced cost), the one that keeps all reduced costs from becoming
/// negative, but for a tolerance that is used to find a large entry (Harris 1973).
pub fn column(candidates: impl Iterator<Item = (usize, f64, f64)> + Clone) -> Option<usize> {
    let fitting = candidates.filter(|&(_, entry, _)| entry < -SMALL);
    let bound = |(_, entry, cost): (usize, f64, f64)| (cost.max(0.0) + TOLERANCE * 0.01) / -entry;
    let most = fitting.clone().map(bound).min_by(f64::total_cmp)?;
    let near = fitting.filter(|&(_, entry, cost)| cost.max(0.0) / -entry <= most);
    near.min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0))).map(|(variable, ..)| variable)
}
