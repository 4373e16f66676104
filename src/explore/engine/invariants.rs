//! Semi-positive place invariants: weighted sums of tokens that no firing changes.
//!
//! The algorithm is Farkas's, in the form given by Colom and Silva (1991): transitions are eliminated one after another, each
//! by all combinations of two rows that change it in opposite directions, and rows whose support holds that of another are
//! left out. The number of minimal invariants can be exponential, so there are limits; rows beyond them are left out, which
//! loses invariants but never makes a wrong one.

use std::collections::BTreeSet;

use super::model::Rule;

/// Places with weights, ascending; in every reachable marking the weighted sum of their tokens is `tokens`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Invariant {
    pub(super) weights: Vec<(usize, u64)>,
    pub(super) tokens: u64,
}

/// Which invariants are wanted.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    /// Those with weights 1 and at most one token. They are found much faster, since tokens of rows only ever add up.
    OneToken,
    /// All.
    Any,
}

/// Rows kept at a time, for each place and in addition.
const ROWS: (usize, usize) = (4, 1000);

/// Elementary steps in all.
const WORK: u64 = 20_000_000;

/// Minimal invariants of a net, perhaps not all.
pub(super) fn invariants(initial: &[u64], rules: &[Rule], wanted: Wanted) -> Vec<Invariant> {
    let mut singles: Vec<Row> = (0..initial.len()).map(|place| Row::of(place, initial[place])).collect();
    for (transition, rule) in rules.iter().enumerate() {
        for touch in rule.iter().filter(|touch| touch.change() != 0) {
            singles[touch.place].changes.push((transition as u32, touch.change()));
        }
    }
    let mut tableau = Tableau::new(initial.len(), rules.len(), wanted);
    singles.into_iter().filter(|row| row.is(wanted)).for_each(|row| tableau.add(row));
    while let Some(&(_, _, transition)) = tableau.order.first() {
        tableau.eliminate(transition);
    }
    let done = tableau.rows.into_iter().flatten().filter(|row| row.changes.is_empty());
    done.map(|row| Invariant { weights: row.weights, tokens: row.tokens }).collect()
}

/// The rows at some stage, and where they are found.
struct Tableau {
    wanted: Wanted,
    /// Rows taken away leave a gap.
    rows: Vec<Option<Row>>,
    len: usize,
    limit: usize,
    work: u64,
    /// The rows that change a transition had when they were added.
    changing: Vec<Vec<u32>>,
    /// The rows whose first place it is.
    beginning: Vec<Vec<u32>>,
    /// How many rows gain and lose tokens by each transition.
    counts: Vec<(u64, u64)>,
    /// The transitions that rows change, that whose elimination adds the fewest rows first; the others in no particular order,
    /// since along a path of places one row would become ever longer if it were followed.
    order: BTreeSet<(i64, u32, u32)>,
}

impl Tableau {
    fn new(places: usize, transitions: usize, wanted: Wanted) -> Self {
        Self {
            wanted,
            rows: Vec::new(),
            len: 0,
            limit: ROWS.0 * places + ROWS.1,
            work: 0,
            changing: vec![Vec::new(); transitions],
            beginning: vec![Vec::new(); places],
            counts: vec![(0, 0); transitions],
            order: BTreeSet::new(),
        }
    }

    fn add(&mut self, row: Row) {
        let number = self.rows.len() as u32;
        row.changes.iter().for_each(|&(transition, _)| self.changing[transition as usize].push(number));
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
        let cost = |(gain, lose): (u64, u64)| (gain * lose) as i64 - (gain + lose) as i64;
        for &(transition, change) in &row.changes {
            let scattered = transition.wrapping_mul(0x9E37_79B9);
            let counts = &mut self.counts[transition as usize];
            self.order.remove(&(cost(*counts), scattered, transition));
            let one = if change > 0 { &mut counts.0 } else { &mut counts.1 };
            *one = one.wrapping_add_signed(sign);
            if *counts != (0, 0) {
                self.order.insert((cost(*counts), scattered, transition));
            }
        }
    }

    /// Replaces the rows that a transition changes by their combinations.
    fn eliminate(&mut self, transition: u32) {
        let numbers = std::mem::take(&mut self.changing[transition as usize]);
        let changed: Vec<Row> = numbers.into_iter().filter_map(|number| self.remove(number)).collect();
        let (gain, lose): (Vec<&Row>, Vec<&Row>) = changed.iter().partition(|row| row.change(transition) > 0);
        let mut fresh: Vec<Row> = Vec::new();
        for one in &gain {
            for other in &lose {
                self.work += 1;
                if self.work > WORK || self.wanted == Wanted::OneToken && one.tokens + other.tokens > 1 {
                    continue;
                }
                let Some(row) = one.combine(other, transition).filter(|row| row.is(self.wanted)) else { continue };
                self.work += (row.weights.len() + row.changes.len() + fresh.len()) as u64;
                if !self.holds_support_in(&row) && !fresh.iter().any(|smaller| row.holds_support_of(smaller)) {
                    fresh.retain(|larger| !larger.holds_support_of(&row));
                    fresh.push(row);
                }
            }
        }
        // Small supports are the more useful ones.
        fresh.sort_by_key(|row| row.weights.len());
        fresh.truncate(self.limit.saturating_sub(self.len));
        fresh.into_iter().for_each(|row| self.add(row));
    }

    /// Whether the support of some row is part of that of another one.
    fn holds_support_in(&mut self, larger: &Row) -> bool {
        larger.weights.iter().any(|&(place, _)| {
            self.work += self.beginning[place].len() as u64;
            let mut smaller = self.beginning[place].iter().filter_map(|&number| self.rows[number as usize].as_ref());
            smaller.any(|smaller| larger.holds_support_of(smaller))
        })
    }
}

/// A weighted sum of places: what it is worth initially, and how the transitions not yet eliminated change it.
struct Row {
    weights: Vec<(usize, u64)>,
    tokens: u64,
    changes: Vec<(u32, i64)>,
    /// A bit for each place modulo 64: no support holds another one unless these do.
    signature: u64,
}

impl Row {
    fn of(place: usize, tokens: u64) -> Self {
        Self { weights: vec![(place, 1)], tokens, changes: Vec::new(), signature: 1 << (place % 64) }
    }

    fn is(&self, wanted: Wanted) -> bool {
        wanted == Wanted::Any || self.tokens <= 1 && self.weights.iter().all(|&(_, weight)| weight == 1)
    }

    fn change(&self, transition: u32) -> i64 {
        self.changes.binary_search_by_key(&transition, |&(t, _)| t).map_or(0, |at| self.changes[at].1)
    }

    fn holds_support_of(&self, other: &Self) -> bool {
        other.signature & !self.signature == 0
            && other.weights.len() <= self.weights.len()
            && other.weights.iter().all(|&(place, _)| self.weights.binary_search_by_key(&place, |&(p, _)| p).is_ok())
    }

    /// The combination of two rows that a transition does not change; nothing if numbers become too large.
    fn combine(&self, other: &Self, transition: u32) -> Option<Self> {
        let (mine, others) = (self.change(transition).unsigned_abs(), other.change(transition).unsigned_abs());
        let common = gcd(mine, others);
        let (a, b) = (others / common, mine / common);
        let weights = merge(&self.weights, &other.weights, |x, y| {
            x.checked_mul(a)?.checked_add(y.checked_mul(b)?).filter(|&weight| weight < 1 << 31)
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

/// Two ascending lists in one, the values of each key combined; 0 stands for a value that is not there.
fn merge<K: Ord + Copy, V: Default + Copy>(
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

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}
