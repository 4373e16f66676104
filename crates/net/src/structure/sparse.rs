//! Sparse vectors: ascending lists of positions with non-zero values.

/// Merges two ascending lists, combining the values of each key; 0 stands for a missing value. `None` if a value cannot
/// be computed.
pub fn merge<K: Ord + Copy, V: Default + Copy>(
    left: &[(K, V)],
    right: &[(K, V)],
    combine: impl Fn(V, V) -> Option<V>,
) -> Option<Vec<(K, V)>> {
    let mut merged = Vec::with_capacity(left.len() + right.len());
    let (mut left, mut right) = (left.iter().copied().peekable(), right.iter().copied().peekable());
    loop {
        let key = match (left.peek(), right.peek()) {
            (Some(&(l, _)), Some(&(r, _))) => l.min(r),
            (Some(&(key, _)), None) | (None, Some(&(key, _))) => key,
            (None, None) => return Some(merged),
        };
        let x = left.next_if(|&(k, _)| k == key).map_or(V::default(), |(_, value)| value);
        let y = right.next_if(|&(k, _)| k == key).map_or(V::default(), |(_, value)| value);
        merged.push((key, combine(x, y)?));
    }
}

/// Greatest common divisor; that of 0 and a number is the number.
pub fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}
