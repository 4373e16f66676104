//! Semi-positive solutions with minimal support: sums of rows, with weights that are not negative, that are 0 in all columns.
//!
//! For rows that say how columns change places these are place invariants, for the other way round column
//! invariants. The algorithm is Farkas's, in the form given by Colom and Silva (1991): columns are eliminated one after
//! another, each by all combinations of two rows that have opposite signs there, and rows whose support holds that of another
//! are left out. The number of minimal solutions can be exponential, so there are limits; rows beyond them are left out, which
//! loses solutions but never makes a wrong one.

use std::collections::BTreeSet;

use super::sparse::{gcd, merge};

/// Which solutions are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Those with weights 1 and at most one token. They are found much faster, since tokens of rows only ever add up.
    OneToken,
    /// All.
    Any,
}

/// How far the search may go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Rows kept at a time, for each row at the beginning.
    pub rows_each: usize,
    /// Rows kept at a time in addition.
    pub rows: usize,
    /// Elementary steps in all.
    pub work: u64,
}

impl Default for Limits {
    /// What takes a fraction of a second.
    fn default() -> Self {
        Self { rows_each: 4, rows: 1000, work: 20_000_000 }
    }
}

/// Weights from here on are not computed with.
const HEAVY: u64 = 1 << 31;

/// The solutions found.
#[derive(Clone, Debug)]
pub struct Solutions {
    /// Rows without changes, whose weights are the solutions.
    pub rows: Vec<Row>,
    /// Whether these are all with minimal support. If not, some support may not be minimal.
    pub all: bool,
}

/// The solutions for rows that are changed in `columns` columns. The positions of the rows are below `count`.
pub fn semiflows(rows: Vec<Row>, count: usize, columns: usize, wanted: Wanted, limits: Limits) -> Solutions {
    let mut tableau = Tableau::new(count, columns, wanted, limits);
    rows.into_iter().filter(|row| row.is(wanted)).for_each(|row| tableau.add(row));
    tableau.sort();
    while let Some(&(_, _, column)) = tableau.order.first() {
        tableau.eliminate(column);
    }
    Solutions { rows: tableau.rows.into_iter().flatten().collect(), all: tableau.all }
}

/// The rows at some stage, and where they are found.
struct Tableau {
    wanted: Wanted,
    /// Rows taken away leave a gap.
    rows: Vec<Option<Row>>,
    len: usize,
    limit: usize,
    /// Elementary steps left.
    work: u64,
    /// Whether no row was left out that might have led to a solution.
    all: bool,
    /// The rows that change a column had when they were added.
    changing: Vec<Vec<u32>>,
    /// The rows whose support begins there.
    beginning: Vec<Vec<u32>>,
    /// How many rows gain and lose by each column.
    counts: Vec<(u64, u64)>,
    /// Columns counted anew, which may stand in a wrong place of the order.
    counted: Vec<u32>,
    /// Where each column stands in the order, if it does.
    costs: Vec<Option<i64>>,
    /// The columns that rows change, that whose elimination adds the fewest rows first; the others in no particular order,
    /// since along a path of places one row would become ever longer if it were followed.
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

    /// Puts columns that were counted anew in their places.
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

    /// Replaces the rows that a column changes by their combinations.
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
        // Small supports are the more useful ones.
        fresh.sort_by_key(|row| row.weights.len());
        let room = self.limit.saturating_sub(self.len);
        self.all &= fresh.len() <= room;
        fresh.truncate(room);
        fresh.into_iter().for_each(|row| self.add(row));
        self.sort();
    }

    /// Takes steps from those left; false if there are none.
    fn takes(&mut self, steps: usize) -> bool {
        let are_left = self.work > 0;
        self.all &= are_left;
        self.work = self.work.saturating_sub(steps as u64);
        are_left
    }

    /// Whether the support of some row is part of that of another one.
    fn holds_support_in(&mut self, larger: &Row) -> bool {
        larger.weights.iter().any(|&(first, _)| {
            self.work = self.work.saturating_sub(self.beginning[first].len() as u64);
            let mut smaller = self.beginning[first].iter().filter_map(|&number| self.rows[number as usize].as_ref());
            smaller.any(|smaller| larger.holds_support_of(smaller))
        })
    }
}

/// A weighted sum of the rows at the beginning: what it is worth initially, and how the columns not yet eliminated change it.
#[derive(Clone, Debug)]
pub struct Row {
    /// Which rows, ascending, and how often each.
    pub weights: Vec<(usize, u64)>,
    /// What the sum is worth initially.
    pub tokens: u64,
    changes: Vec<(u32, i64)>,
    /// A bit for each position modulo 64: no support holds another one unless these do.
    signature: u64,
}

impl Row {
    /// A row as it is at the beginning, with how the columns change it, ascending, and without zeros.
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

    /// The combination of two rows that a column does not change; nothing if numbers become too large.
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

    /// Divides by what all weights have in common.
    fn reduce(&mut self) {
        let common = self.weights.iter().fold(0, |common, &(_, weight)| gcd(common, weight));
        if common > 1 {
            self.weights.iter_mut().for_each(|(_, weight)| *weight /= common);
            self.changes.iter_mut().for_each(|(_, change)| *change /= common as i64);
            self.tokens /= common;
        }
    }
}
