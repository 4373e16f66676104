//! Invariants, siphons and traps as their definitions have them, by trying all sets.

use std::collections::BTreeSet;

use petril::net::Net;

/// A matrix by rows.
pub type Matrix = Vec<Vec<i128>>;

/// What each transition (column) adds to each place (row).
pub fn incidence(net: &Net) -> Matrix {
    let mut matrix = vec![vec![0; net.transitions().len()]; net.places().len()];
    for id in net.transition_ids() {
        net.pre(id).for_each(|(place, weight)| matrix[place.index()][id.index()] -= i128::from(weight));
        net.post(id).for_each(|(place, weight)| matrix[place.index()][id.index()] += i128::from(weight));
    }
    matrix
}

/// Rows become columns.
pub fn transposed(matrix: &Matrix, columns: usize) -> Matrix {
    (0..columns).map(|column| matrix.iter().map(|row| row[column]).collect()).collect()
}

/// The rank, by Gauss's algorithm without fractions.
pub fn rank(mut rows: Matrix) -> usize {
    let columns = rows.first().map_or(0, Vec::len);
    let mut rank = 0;
    for column in 0..columns {
        let Some(pivot) = (rank..rows.len()).find(|&row| rows[row][column] != 0) else { continue };
        rows.swap(rank, pivot);
        for row in rank + 1..rows.len() {
            let (a, b) = (rows[rank][column], rows[row][column]);
            let top = rows[rank].clone();
            rows[row].iter_mut().zip(top).for_each(|(x, y)| *x = *x * a - y * b);
            let common = rows[row].iter().fold(0, |common, &x| gcd(common, x.abs()));
            if common > 1 {
                rows[row].iter_mut().for_each(|x| *x /= common);
            }
        }
        rank += 1;
    }
    rank
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The minors that say how rows, one more than their rank, depend on each other: each is the determinant without that row.
fn dependence(rows: &Matrix) -> Option<Vec<i128>> {
    let columns = rows.first().map_or(0, Vec::len);
    // Enough columns to have full rank without one of the rows.
    let mut chosen: Vec<usize> = Vec::new();
    for column in 0..columns {
        let with = |columns: &[usize]| rows.iter().map(|row| columns.iter().map(|&c| row[c]).collect()).collect();
        let more: Vec<usize> = chosen.iter().copied().chain([column]).collect();
        if rank(with(&more)) == more.len() {
            chosen = more;
        }
    }
    if chosen.len() + 1 != rows.len() {
        return None;
    }
    let minor = |without: usize| {
        let left: Matrix = rows
            .iter()
            .enumerate()
            .filter(|&(row, _)| row != without)
            .map(|(_, row)| chosen.iter().map(|&column| row[column]).collect())
            .collect();
        determinant(&left) * if without.is_multiple_of(2) { 1 } else { -1 }
    };
    let weights: Vec<i128> = (0..rows.len()).map(minor).collect();
    let common = weights.iter().fold(0, |common, &weight| gcd(common, weight.abs()));
    Some(weights.into_iter().map(|weight| weight / common).collect())
}

/// By its definition.
fn determinant(matrix: &Matrix) -> i128 {
    let Some((first, rest)) = matrix.split_first() else { return 1 };
    let without =
        |column: usize| rest.iter().map(|row| [&row[..column], &row[column + 1..]].concat()).collect::<Matrix>();
    let sign = |column: usize| if column.is_multiple_of(2) { 1 } else { -1 };
    (0..first.len()).filter(|&c| first[c] != 0).map(|c| sign(c) * first[c] * determinant(&without(c))).sum()
}

/// The semi-positive sums of rows that are 0 and have minimal support: (row, weight) ascending.
pub fn semiflows(matrix: &Matrix) -> BTreeSet<Vec<(usize, u64)>> {
    let sets = (1_u32..1 << matrix.len()).filter_map(|set| {
        let rows: Vec<usize> = (0..matrix.len()).filter(|row| set >> row & 1 == 1).collect();
        let weights = dependence(&rows.iter().map(|&row| matrix[row].clone()).collect())?;
        let positive = |sign: i128| weights.iter().all(|weight| weight * sign > 0);
        (positive(1) || positive(-1))
            .then(|| rows.iter().zip(&weights).map(|(&row, weight)| (row, weight.unsigned_abs() as u64)).collect())
    });
    sets.collect()
}

/// Sets of places that are siphons, by bits.
pub fn siphons(net: &Net) -> Vec<u32> {
    closed(net, |net, id| (places(net.post(id)), places(net.pre(id))))
}

/// Sets of places that are traps, by bits.
pub fn traps(net: &Net) -> Vec<u32> {
    closed(net, |net, id| (places(net.pre(id)), places(net.post(id))))
}

fn places(arcs: impl Iterator<Item = (petril::net::PlaceId, u64)>) -> u32 {
    arcs.fold(0, |set, (place, _)| set | 1 << place.index())
}

/// Sets of places such that each transition that has one of them on one side has one of them on the other.
fn closed(net: &Net, sides: impl Fn(&Net, petril::net::TransitionId) -> (u32, u32)) -> Vec<u32> {
    let sides: Vec<(u32, u32)> = net.transition_ids().map(|id| sides(net, id)).collect();
    let is_closed = |&set: &u32| sides.iter().all(|&(one, other)| one & set == 0 || other & set != 0);
    (1_u32..1 << net.places().len()).filter(is_closed).collect()
}

/// The sets that hold no other one.
pub fn minimal(sets: &[u32]) -> BTreeSet<u32> {
    sets.iter().copied().filter(|set| !sets.iter().any(|other| other != set && other & set == *other)).collect()
}
