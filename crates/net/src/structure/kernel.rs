//! A basis of the left kernel of an integer matrix, for nets with too many solutions of minimal support; weights may be
//! negative.
//!
//! Fraction-free Gaussian elimination: of the rows with an entry in a column, the shortest is the pivot; multiples of
//! it are subtracted from the others, and it is dropped. The rows left in the end are zero in every column; the number
//! of dropped rows is the rank of the matrix.

use std::collections::BTreeSet;

use super::sparse::{gcd, merge};

/// Sparse vector: rows with their multiplicities, or columns with their entries.
type Vector = Vec<(u32, i128)>;

/// Basis of the left kernel: independent sums of rows that are 0 in all columns. Every other such sum is a rational
/// combination of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Kernel {
    /// Basis vectors: rows, ascending, with weights.
    pub vectors: Vec<Vector>,
    /// The rank of the matrix.
    pub rank: usize,
}

/// Computes the left kernel of a matrix given by rows. `None` if more than `steps` elementary steps are needed, or
/// numbers become too large.
pub fn kernel(rows: impl Iterator<Item = Vector>, columns: usize, mut steps: u64) -> Option<Kernel> {
    let mut rows: Vec<Option<(Vector, Vector)>> =
        rows.enumerate().map(|(position, changes)| Some((vec![(position as u32, 1)], changes))).collect();
    let mut changing: Vec<BTreeSet<u32>> = vec![BTreeSet::new(); columns];
    for (number, (_, changes)) in rows.iter().flatten().enumerate() {
        changes.iter().for_each(|&(column, _)| _ = changing[column as usize].insert(number as u32));
    }
    // Columns with the fewest entries come first; ties are broken by a hash, since along a chain rows would grow long.
    let key = |changing: &[BTreeSet<u32>], column: u32| {
        (changing[column as usize].len(), column.wrapping_mul(0x9E37_79B9), column)
    };
    let mut order: BTreeSet<(usize, u32, u32)> =
        (0..columns as u32).map(|column| key(&changing, column)).filter(|&(count, ..)| count > 0).collect();
    let mut rank = 0;
    while let Some(&(_, _, column)) = order.first() {
        let numbers: Vec<u32> = changing[column as usize].iter().copied().collect();
        let length =
            |&number: &u32| rows[number as usize].as_ref().map_or(0, |(sum, changes)| sum.len() + changes.len());
        let shortest = numbers.iter().copied().min_by_key(length)?;
        let (pivot_sum, pivot) = rows[shortest as usize].take()?;
        let by = at(&pivot, column);
        // Updates the columns in which a row has entries.
        let mut update = |number: u32, before: &Vector, now: &Vector| {
            for (column, present) in differences(before, now) {
                order.remove(&key(&changing, column));
                let these = &mut changing[column as usize];
                _ = if present { these.insert(number) } else { these.remove(&number) };
                if !these.is_empty() {
                    order.insert(key(&changing, column));
                }
            }
        };
        update(shortest, &pivot, &Vec::new());
        for number in numbers.into_iter().filter(|&number| number != shortest) {
            let (sum, changes) = rows[number as usize].take()?;
            let own = at(&changes, column);
            let length = 4 * (sum.len() + changes.len() + pivot_sum.len()) + 40 * pivot.len();
            steps = steps.checked_sub(length as u64)?;
            let combine = |x: i128, y: i128| x.checked_mul(by)?.checked_sub(y.checked_mul(own)?);
            let mut fresh = [(&sum, &pivot_sum), (&changes, &pivot)].map(|(one, other)| merge(one, other, combine));
            fresh.iter_mut().flatten().for_each(|vector| vector.retain(|&(_, value)| value != 0));
            let [Some(mut fresh_sum), Some(mut fresh)] = fresh else { return None };
            reduce(&mut fresh_sum, &mut fresh)?;
            update(number, &changes, &fresh);
            rows[number as usize] = Some((fresh_sum, fresh));
        }
        rank += 1;
    }
    Some(Kernel { vectors: rows.into_iter().flatten().map(|(sum, _)| sum).collect(), rank })
}

/// Columns that are in only one of two vectors, and whether in the second one.
fn differences(before: &Vector, now: &Vector) -> Vec<(u32, bool)> {
    let (mut before, mut now) = (before.iter().map(|&(c, _)| c).peekable(), now.iter().map(|&(c, _)| c).peekable());
    let mut differences = Vec::new();
    loop {
        match (before.peek().copied(), now.peek().copied()) {
            (Some(b), Some(n)) if b == n => _ = (before.next(), now.next()),
            (Some(b), n) if n.is_none_or(|n| b < n) => {
                differences.push((b, false));
                before.next();
            }
            (_, Some(n)) => {
                differences.push((n, true));
                now.next();
            }
            _ => return differences,
        }
    }
}

fn at(vector: &Vector, column: u32) -> i128 {
    vector.binary_search_by_key(&column, |&(c, _)| c).map_or(0, |at| vector[at].1)
}

/// Divides both vectors by the greatest common divisor of all their entries. `None` if a number is too large.
fn reduce(sum: &mut Vector, changes: &mut Vector) -> Option<()> {
    let mut common = 0;
    for &(_, value) in sum.iter().chain(changes.iter()) {
        common = gcd(common, u64::try_from(value.unsigned_abs()).ok()?);
    }
    for (_, value) in sum.iter_mut().chain(changes) {
        *value /= i128::from(common);
    }
    Some(())
}
