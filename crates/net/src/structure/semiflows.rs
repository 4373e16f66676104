//! Semiflows of minimal support: sums of rows, with non-negative weights, that are 0 in all columns.
//!
//! With places as rows and transitions as columns these are place invariants, the other way round transition
//! invariants. The algorithm is Farkas's, in the form given by Colom and Silva (1991): columns are eliminated one after
//! another, each by all combinations of two rows with opposite signs there, and rows whose support contains that of
//! another are left out. The number of minimal solutions can be exponential, so there are limits; rows beyond them are
//! left out, which loses solutions but never makes a wrong one.

use std::collections::BTreeSet;

use super::sparse::{gcd, merge};

/// Kind of solutions wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Solutions with weights 1 and at most one token. They are found much faster, since tokens of rows only add up.
    OneToken,
    /// All solutions.
    Any,
}

/// Limits of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Maximum number of rows kept at a time, per initial row.
    pub rows_each: usize,
    /// Maximum number of rows kept at a time in addition.
    pub rows: usize,
    /// Maximum number of elementary steps.
    pub work: u64,
}

impl Default for Limits {
    /// Limits for a fraction of a second.
    fn default() -> Self {
        Self { rows_each: 4, rows: 1000, work: 20_000_000 }
    }
}

/// Upper bound (exclusive) on weights; combinations beyond it are left out.
const HEAVY: u64 = 1 << 31;

/// Result of a search for semiflows.
#[derive(Clone, Debug)]
pub struct Solutions {
    /// Rows without entries left, whose weights are the solutions.
    pub rows: Vec<Row>,
    /// Whether `rows` is complete: all solutions of minimal support. If not, some support may not be minimal.
    pub all: bool,
}

/// Computes the semiflows of a matrix with `columns` columns. The positions of the rows are below `count`.
pub fn semiflows(rows: Vec<Row>, count: usize, columns: usize, wanted: Wanted, limits: Limits) -> Solutions {
    let mut tableau = Tableau::new(count, columns, wanted, limits);
    rows.into_iter().filter(|row| row.is(wanted)).for_each(|row| tableau.add(row));
    tableau.sort();
    while let Some(&(_, _, column)) = tableau.order.first() {
        tableau.eliminate(column);
    }
    Solutions { rows: tableau.rows.into_iter().flatten().collect(), all: tableau.all }
}

/// The rows during elimination, with indexes.
struct Tableau {
    wanted: Wanted,
    /// Rows by number; removed ones leave a gap.
    rows: Vec<Option<Row>>,
    len: usize,
    limit: usize,
    /// Elementary steps left.
    work: u64,
    /// Whether no row has been left out that might have led to a solution.
    all: bool,
    /// For each column, the rows that had an entry there when they were added.
    changing: Vec<Vec<u32>>,
    /// For each position, the rows whose support begins there.
    beginning: Vec<Vec<u32>>,
    /// For each column, the numbers of rows with positive and with negative entries.
    counts: Vec<(u64, u64)>,
    /// Columns whose counts changed, so that their place in `order` may be out of date.
    counted: Vec<u32>,
    /// Cost under which each column is in `order`, if it is.
    costs: Vec<Option<i64>>,
    /// Columns with entries, by the number of rows that their elimination adds; ties are broken by a hash, since
    /// following a path of places would make one row ever longer.
    order: BTreeSet<(i64, u32, u32)>,
}

impl Tableau {
    fn new(rows: usize, columns: usize, wanted: Wanted, limits: Limits) -> Self {
        Self {
            wanted,
            rows: Vec::new(),
            len: 0,
            limit: limits.rows_each * rows + limits.rows,
            work: limits.work,
            all: true,
            changing: vec![Vec::new(); columns],
            beginning: vec![Vec::new(); rows],
            counts: vec![(0, 0); columns],
            counted: Vec::new(),
            costs: vec![None; columns],
            order: BTreeSet::new(),
        }
    }

    fn add(&mut self, row: Row) {
        let number = self.rows.len() as u32;
        row.changes.iter().for_each(|&(column, _)| self.changing[column as usize].push(number));
        self.beginning[row.weights[0].0].push(number);
        self.count(&row, 1);
        self.rows.push(Some(row));
        self.len += 1;
    }

    fn remove(&mut self, number: u32) -> Option<Row> {
        let row = self.rows[number as usize].take()?;
        self.count(&row, -1);
        self.len -= 1;
        Some(row)
    }

    fn count(&mut self, row: &Row, sign: i64) {
        for &(column, change) in &row.changes {
            let (gain, lose) = &mut self.counts[column as usize];
            let one = if change > 0 { gain } else { lose };
            *one = one.wrapping_add_signed(sign);
            self.counted.push(column);
        }
    }

    /// Restores the order of columns whose counts changed.
    fn sort(&mut self) {
        let cost = |(gain, lose): (u64, u64)| (gain * lose) as i64 - (gain + lose) as i64;
        for column in self.counted.drain(..) {
            let counts = self.counts[column as usize];
            let now = (counts != (0, 0)).then(|| cost(counts));
            let before = std::mem::replace(&mut self.costs[column as usize], now);
            if before != now {
                let scattered = column.wrapping_mul(0x9E37_79B9);
                before.map(|cost| self.order.remove(&(cost, scattered, column)));
                now.map(|cost| self.order.insert((cost, scattered, column)));
            }
        }
    }

    /// Eliminates a column: replaces the rows with an entry there by their combinations.
    fn eliminate(&mut self, column: u32) {
        let numbers = std::mem::take(&mut self.changing[column as usize]);
        let changed: Vec<Row> = numbers.into_iter().filter_map(|number| self.remove(number)).collect();
        let (gain, lose): (Vec<&Row>, Vec<&Row>) = changed.iter().partition(|row| row.change(column) > 0);
        let mut fresh: Vec<Row> = Vec::new();
        for one in &gain {
            for other in &lose {
                if !self.takes(1) {
                    break;
                }
                if self.wanted == Wanted::OneToken && one.tokens + other.tokens > 1 {
                    continue;
                }
                let Some(row) = one.combine(other, column) else {
                    self.all = false;
                    continue;
                };
                if !row.is(self.wanted) {
                    continue;
                }
                self.takes(row.weights.len() + row.changes.len() + fresh.len());
                if !self.holds_support_in(&row) && !fresh.iter().any(|smaller| row.holds_support_of(smaller)) {
                    fresh.retain(|larger| !larger.holds_support_of(&row));
                    fresh.push(row);
                }
            }
        }
        // Small supports are more useful.
        fresh.sort_by_key(|row| row.weights.len());
        let room = self.limit.saturating_sub(self.len);
        self.all &= fresh.len() <= room;
        fresh.truncate(room);
        fresh.into_iter().for_each(|row| self.add(row));
        self.sort();
    }

    /// Spends elementary steps; returns false if none are left.
    fn takes(&mut self, steps: usize) -> bool {
        let are_left = self.work > 0;
        self.all &= are_left;
        self.work = self.work.saturating_sub(steps as u64);
        are_left
    }

    /// Whether the support of a row contains that of a row of the tableau.
    fn holds_support_in(&mut self, larger: &Row) -> bool {
        larger.weights.iter().any(|&(first, _)| {
            self.work = self.work.saturating_sub(self.beginning[first].len() as u64);
            let mut smaller = self.beginning[first].iter().filter_map(|&number| self.rows[number as usize].as_ref());
            smaller.any(|smaller| larger.holds_support_of(smaller))
        })
    }
}

/// A weighted sum of initial rows: its initial value, and its entries in columns not yet eliminated.
#[derive(Clone, Debug)]
pub struct Row {
    /// Initial rows, ascending, with their weights.
    pub weights: Vec<(usize, u64)>,
    /// Initial value of the sum.
    pub tokens: u64,
    changes: Vec<(u32, i64)>,
    /// A bit for each position modulo 64: a support contains another one only if its signature does.
    signature: u64,
}

impl Row {
    /// Makes an initial row, with its entries in columns, ascending and without zeros.
    pub fn of(position: usize, tokens: u64, changes: Vec<(u32, i64)>) -> Self {
        Self { weights: vec![(position, 1)], tokens, changes, signature: 1 << (position % 64) }
    }

    fn is(&self, wanted: Wanted) -> bool {
        wanted == Wanted::Any || self.tokens <= 1 && self.weights.iter().all(|&(_, weight)| weight == 1)
    }

    fn change(&self, column: u32) -> i64 {
        self.changes.binary_search_by_key(&column, |&(t, _)| t).map_or(0, |at| self.changes[at].1)
    }

    fn holds_support_of(&self, other: &Self) -> bool {
        other.signature & !self.signature == 0
            && other.weights.len() <= self.weights.len()
            && other.weights.iter().all(|&(one, _)| self.weights.binary_search_by_key(&one, |&(p, _)| p).is_ok())
    }

    /// Combination of two rows that is 0 in a column; `None` if numbers become too large.
    fn combine(&self, other: &Self, column: u32) -> Option<Self> {
        let (mine, others) = (self.change(column).unsigned_abs(), other.change(column).unsigned_abs());
        let common = gcd(mine, others);
        let (a, b) = (others / common, mine / common);
        let weights = merge(&self.weights, &other.weights, |x, y| {
            x.checked_mul(a)?.checked_add(y.checked_mul(b)?).filter(|&weight| weight < HEAVY)
        })?;
        let (signed_a, signed_b) = (i64::try_from(a).ok()?, i64::try_from(b).ok()?);
        let mut changes = merge(&self.changes, &other.changes, |x, y| {
            x.checked_mul(signed_a)?.checked_add(y.checked_mul(signed_b)?)
        })?;
        changes.retain(|&(_, change)| change != 0);
        let tokens = self.tokens.checked_mul(a)?.checked_add(other.tokens.checked_mul(b)?)?;
        let mut row = Self { weights, tokens, changes, signature: self.signature | other.signature };
        row.reduce();
        Some(row)
    }

    /// Divides the row by the greatest common divisor of its weights.
    fn reduce(&mut self) {
        let common = self.weights.iter().fold(0, |common, &(_, weight)| gcd(common, weight));
        if common > 1 {
            self.weights.iter_mut().for_each(|(_, weight)| *weight /= common);
            self.changes.iter_mut().for_each(|(_, change)| *change /= common as i64);
            self.tokens /= common;
        }
    }
}
