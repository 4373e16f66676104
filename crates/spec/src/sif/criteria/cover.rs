//! Set cover: a smallest set of columns such that each row contains one.
//!
//! First, dominated rows and columns are removed; then the largest column is taken repeatedly (greedy), redundant
//! columns are dropped, and, if little is left, branch and bound follows, with disjoint rows as the lower bound. After
//! Coudert, "Two-level logic minimization: an overview" (1994).

use fixedbitset::FixedBitSet;
use rustc_hash::FxHashSet;

use super::super::solver::Stop;

/// Set of columns that covers all rows.
#[derive(Debug)]
pub struct Cover {
    /// Columns chosen.
    pub chosen: Vec<usize>,
    /// Whether the cover is proved to be minimum.
    pub is_smallest: bool,
}

/// Upper bound on rows and columns examined in each step.
const MAX_WORK: usize = 5_000_000;

/// Finds a small cover. Rows are sets of columns; empty ones are ignored.
#[must_use]
pub fn cover(rows: &[FixedBitSet], columns: usize, stop: &Stop) -> Cover {
    let rows = fewest(rows, columns);
    // Transposed matrix: the rows of each column.
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
    let mut search = Search { sets: &sets, rows: &rows_of, best, work: 0, stop };
    let is_done = search.branch(&all, &mut Vec::new());
    let mut chosen: Vec<usize> = search.best.iter().map(|at| useful[*at]).collect();
    chosen.sort_unstable();
    Cover { chosen, is_smallest: is_done }
}

/// Removes duplicate rows and rows that contain another row, as far as the work limit allows.
fn fewest(rows: &[FixedBitSet], columns: usize) -> Vec<FixedBitSet> {
    let mut order = distinct(rows);
    order.sort_by_key(|(count, at)| (*count, *at));
    let mut times = vec![0_usize; columns];
    order.iter().for_each(|(_, at)| rows[*at].ones().for_each(|column| times[column] += 1));
    // Rows contained in this one are looked up under their rarest column.
    let mut kept: Vec<Vec<usize>> = vec![Vec::new(); columns];
    let (mut found, mut work) = (Vec::new(), 0);
    for (_, at) in order {
        let row = &rows[at];
        let is_needless = work < MAX_WORK
            && row.ones().any(|column| {
                work += 1 + kept[column].len();
                kept[column].iter().any(|fewer| rows[*fewer].is_subset(row))
            });
        if !is_needless {
            found.push(row.clone());
            let rarest = row.ones().min_by_key(|column| times[*column]);
            rarest.into_iter().for_each(|column| kept[column].push(at));
        }
    }
    found
}

/// Removes columns contained in another column, as far as the work limit allows; largest first.
fn largest(columns: &[FixedBitSet]) -> Vec<usize> {
    let mut order = distinct(columns);
    order.sort_by_key(|(count, at)| (usize::MAX - count, *at));
    let (mut kept, mut work): (Vec<usize>, usize) = (Vec::new(), 0);
    for (_, at) in order {
        let is_needless = work < MAX_WORK
            && kept.iter().any(|larger| {
                work += 1;
                columns[at].is_subset(&columns[*larger])
            });
        if !is_needless {
            kept.push(at);
        }
    }
    kept
}

/// Distinct non-empty sets: size and position of each.
fn distinct(sets: &[FixedBitSet]) -> Vec<(usize, usize)> {
    let mut seen: FxHashSet<&FixedBitSet> = FxHashSet::default();
    let counted = sets.iter().enumerate().map(|(at, set)| (set.count_ones(..), at));
    counted.filter(|(count, at)| *count > 0 && seen.insert(&sets[*at])).collect()
}

/// Greedy cover: repeatedly takes the column with most uncovered rows.
fn greedy(columns: &[FixedBitSet], all: &FixedBitSet) -> Vec<usize> {
    let (mut left, mut chosen) = (all.clone(), Vec::new());
    // An earlier count is an upper bound of the current one.
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

/// Removes redundant columns, beginning with the last one chosen.
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

/// Branch-and-bound search.
struct Search<'c> {
    sets: &'c [FixedBitSet],
    rows: &'c [Vec<usize>],
    best: Vec<usize>,
    work: usize,
    stop: &'c Stop,
}

impl Search<'_> {
    /// Searches for a smaller cover that extends the columns chosen so far. Returns whether the search was exhaustive.
    fn branch(&mut self, left: &FixedBitSet, chosen: &mut Vec<usize>) -> bool {
        if left.is_clear() {
            if chosen.len() < self.best.len() {
                self.best.clone_from(chosen);
            }
            return true;
        }
        self.work += self.sets.len() / 64;
        if self.work > MAX_WORK || (self.stop)() {
            return false;
        }
        if chosen.len() + self.bound(left) >= self.best.len() {
            return true;
        }
        let Some(row) = left.ones().min_by_key(|row| self.rows[*row].len()) else { return true };
        self.work += self.rows[row].len() * self.rows.len().div_ceil(64);
        let mut columns: Vec<(usize, usize)> =
            self.rows[row].iter().map(|column| (self.sets[*column].intersection_count(left), *column)).collect();
        columns.sort_by_key(|(count, column)| (usize::MAX - count, *column));
        let mut is_done = true;
        for (_, column) in columns {
            if self.work > MAX_WORK {
                return false;
            }
            let mut next = left.clone();
            next.difference_with(&self.sets[column]);
            chosen.push(column);
            is_done &= self.branch(&next, chosen);
            chosen.pop();
        }
        is_done
    }

    /// Lower bound: the number of pairwise disjoint rows, each of which needs a column of its own.
    fn bound(&mut self, left: &FixedBitSet) -> usize {
        let mut taken = FixedBitSet::with_capacity(self.sets.len());
        let mut rows: Vec<usize> = left.ones().collect();
        rows.sort_by_key(|row| self.rows[*row].len());
        let mut count = 0;
        for row in rows {
            let columns = &self.rows[row];
            self.work += 1 + columns.len();
            if !columns.iter().any(|column| taken.contains(*column)) {
                columns.iter().for_each(|column| taken.insert(*column));
                count += 1;
            }
        }
        count
    }
}
