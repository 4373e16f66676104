//! Lists of arcs with their weights.

use super::PlaceId;

/// The places of a list, ascending, each with its weight; `weights` is empty if all are 1.
pub fn list<'n>(places: &'n [PlaceId], weights: &'n [u64]) -> impl Iterator<Item = (PlaceId, u64)> + Clone + 'n {
    places.iter().enumerate().map(|(i, &place)| (place, weights.get(i).copied().unwrap_or(1)))
}

/// Merges two ascending lists, and adds the weights of a place in both.
pub fn merge<I, J>(left: I, right: J) -> impl Iterator<Item = (PlaceId, u64)> + Clone
where
    I: Iterator<Item = (PlaceId, u64)> + Clone,
    J: Iterator<Item = (PlaceId, u64)> + Clone,
{
    let (mut left, mut right) = (left.peekable(), right.peekable());
    std::iter::from_fn(move || match (left.peek().copied(), right.peek().copied()) {
        (Some((a, weight)), Some((b, more))) if a == b => {
            left.next();
            right.next();
            Some((a, weight.saturating_add(more)))
        }
        (Some((a, _)), Some((b, _))) if a < b => left.next(),
        (Some(_), None) => left.next(),
        _ => right.next(),
    })
}
