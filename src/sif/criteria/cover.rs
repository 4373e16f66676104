//! Smallest sets: of columns such that each row has one of them.
//!
//! Rows that hold another, and columns that another holds, are left out first; then the largest column again and again (greedy),
//! what has become needless taken out, and, where little is left, branch and bound: a lower bound are rows that share no column.
//! After Coudert, "Two-level logic minimization: an overview" (1994).

use fixedbitset::FixedBitSet;
use rustc_hash::FxHashSet;

use super::super::solver::Stop;

/// Columns that cover all rows.
#[derive(Debug)]
pub struct Cover {
    /// The columns.
    pub chosen: Vec<usize>,
    /// Whether it is proved that fewer do not cover all.
    pub is_smallest: bool,
}

/// Most rows, and most columns, that are compared with each other.
const MAX_COMPARED: usize = 3000;

/// Most steps of branch and bound.
const MAX_STEPS: u64 = 200_000;

/// A small set of columns that has one at least of each row. Rows are sets of columns; empty ones are passed over.
#[must_use]
pub fn cover(rows: &[FixedBitSet], columns: usize, stop: &Stop) -> Cover {
    let rows = fewest(rows);
    // What is left, the other way round: which rows each column is in.
    let mut of = vec![FixedBitSet::with_capacity(rows.len()); columns];
    for (at, row) in rows.iter().enumerate() {
        row.ones().for_each(|column| of[column].insert(at));
    }
    let useful = largest(&of);
    let sets: Vec<FixedBitSet> = useful.iter().map(|column| of[*column].clone()).collect();
    let mut rows_of = vec![Vec::new(); rows.len()];
    for (at, set) in sets.iter().enumerate() {
        set.ones().for_each(|row| rows_of[row].push(at));
    }
    let mut all = FixedBitSet::with_capacity(rows.len());
    all.insert_range(..);
    let mut best = greedy(&sets, &all);
    lean(&sets, &all, &mut best);
    let mut search = Search { sets: &sets, rows: &rows_of, best, steps: 0, stop };
    let is_done = search.branch(&all, &mut Vec::new());
    let mut chosen: Vec<usize> = search.best.iter().map(|at| useful[*at]).collect();
    chosen.sort_unstable();
    Cover { chosen, is_smallest: is_done }
}

/// The rows that hold no other, each once.
fn fewest(rows: &[FixedBitSet]) -> Vec<FixedBitSet> {
    let mut seen: FxHashSet<&FixedBitSet> = FxHashSet::default();
    let mut rows: Vec<(usize, &FixedBitSet)> = rows
        .iter()
        .map(|row| (row.count_ones(..), row))
        .filter(|(count, row)| *count > 0 && seen.insert(row))
        .collect();
    rows.sort_by_key(|(count, _)| *count);
    let mut kept: Vec<FixedBitSet> = Vec::new();
    for (_, row) in rows {
        if !kept.iter().take(MAX_COMPARED).any(|fewer| fewer.is_subset(row)) {
            kept.push(row.clone());
        }
    }
    kept
}

/// The columns that no other holds, largest first.
fn largest(columns: &[FixedBitSet]) -> Vec<usize> {
    let mut seen: FxHashSet<&FixedBitSet> = FxHashSet::default();
    let mut order: Vec<(usize, usize)> = columns
        .iter()
        .enumerate()
        .filter(|(_, column)| seen.insert(column))
        .map(|(at, column)| (column.count_ones(..), at))
        .filter(|(count, _)| *count > 0)
        .collect();
    order.sort_by_key(|(count, at)| (usize::MAX - count, *at));
    let mut kept: Vec<usize> = Vec::new();
    for (_, at) in order {
        if !kept.iter().take(MAX_COMPARED).any(|larger| columns[at].is_subset(&columns[*larger])) {
            kept.push(at);
        }
    }
    kept
}

/// The column with most of what is left, again and again.
fn greedy(columns: &[FixedBitSet], all: &FixedBitSet) -> Vec<usize> {
    let (mut left, mut chosen) = (all.clone(), Vec::new());
    // What a column had before is a bound for what it has now.
    let mut bounds: Vec<usize> = columns.iter().map(|column| column.count_ones(..)).collect();
    while !left.is_clear() {
        let (mut most, mut best) = (0, None);
        for (at, column) in columns.iter().enumerate() {
            if bounds[at] > most {
                bounds[at] = column.intersection_count(&left);
                if bounds[at] > most {
                    (most, best) = (bounds[at], Some(at));
                }
            }
        }
        let Some(best) = best else { break };
        left.difference_with(&columns[best]);
        chosen.push(best);
    }
    chosen
}

/// Takes out what the others cover, beginning with what was chosen last.
fn lean(columns: &[FixedBitSet], all: &FixedBitSet, chosen: &mut Vec<usize>) {
    for at in (0..chosen.len()).rev() {
        let mut left = all.clone();
        let others = chosen.iter().enumerate().filter(|(other, _)| *other != at);
        others.for_each(|(_, column)| left.difference_with(&columns[*column]));
        if left.is_clear() {
            chosen.remove(at);
        }
    }
}

/// Branch and bound.
struct Search<'c> {
    sets: &'c [FixedBitSet],
    rows: &'c [Vec<usize>],
    best: Vec<usize>,
    steps: u64,
    stop: &'c Stop,
}

impl Search<'_> {
    /// Looks for a smaller set that begins with the columns chosen so far. Whether nothing was left out.
    fn branch(&mut self, left: &FixedBitSet, chosen: &mut Vec<usize>) -> bool {
        if left.is_clear() {
            if chosen.len() < self.best.len() {
                self.best.clone_from(chosen);
            }
            return true;
        }
        self.steps += 1;
        if self.steps > MAX_STEPS || (self.steps.is_multiple_of(64) && (self.stop)()) {
            return false;
        }
        if chosen.len() + self.bound(left) >= self.best.len() {
            return true;
        }
        let Some(row) = left.ones().min_by_key(|row| self.rows[*row].len()) else { return true };
        let mut columns: Vec<(usize, usize)> =
            self.rows[row].iter().map(|column| (self.sets[*column].intersection_count(left), *column)).collect();
        columns.sort_by_key(|(count, column)| (usize::MAX - count, *column));
        let mut is_done = true;
        for (_, column) in columns {
            let mut next = left.clone();
            next.difference_with(&self.sets[column]);
            chosen.push(column);
            is_done &= self.branch(&next, chosen);
            chosen.pop();
        }
        is_done
    }

    /// So many rows share no column: each needs one of its own.
    fn bound(&self, left: &FixedBitSet) -> usize {
        let mut taken = FixedBitSet::with_capacity(self.sets.len());
        let mut rows: Vec<usize> = left.ones().collect();
        rows.sort_by_key(|row| self.rows[*row].len());
        let mut count = 0;
        for row in rows {
            if !self.rows[row].iter().any(|column| taken.contains(*column)) {
                self.rows[row].iter().for_each(|column| taken.insert(*column));
                count += 1;
            }
        }
        count
    }
}
