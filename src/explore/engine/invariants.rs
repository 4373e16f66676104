//! Semi-positive place invariants: weighted sums of tokens that no firing changes.
//!
//! The algorithm is Farkas's, in the form given by Colom and Silva (1991): transitions are eliminated one after another, each
//! by all combinations of two rows that change it in opposite directions, and rows whose support holds that of another are
//! left out. The number of minimal invariants can be exponential, so there are limits; rows beyond them are left out, which
//! loses invariants but never makes a wrong one.

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
    let mut rows: Vec<Row> = (0..initial.len()).map(|place| Row::of(place, initial[place])).collect();
    for (transition, rule) in rules.iter().enumerate() {
        for touch in rule.iter().filter(|touch| touch.change() != 0) {
            rows[touch.place].changes.push((transition as u32, touch.change()));
        }
    }
    rows.retain(|row| row.is(wanted));
    let limit = ROWS.0 * initial.len() + ROWS.1;
    let mut work = 0;
    let mut counts = Counts::of(&rows, rules.len());
    while let Some(transition) = counts.cheapest() {
        work += rules.len() as u64;
        eliminate(transition, &mut rows, wanted, limit, &mut counts, &mut work);
        if work > WORK {
            rows.retain(|row| row.changes.is_empty());
            break;
        }
    }
    rows.into_iter().map(|row| Invariant { weights: row.weights, tokens: row.tokens }).collect()
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

/// How many rows gain and lose tokens by each transition.
struct Counts(Vec<(u64, u64)>);

impl Counts {
    fn of(rows: &[Row], transitions: usize) -> Self {
        let mut counts = Self(vec![(0, 0); transitions]);
        rows.iter().for_each(|row| counts.add(row, 1));
        counts
    }

    fn add(&mut self, row: &Row, sign: i64) {
        for &(transition, change) in &row.changes {
            let (gain, lose) = &mut self.0[transition as usize];
            let count = if change > 0 { gain } else { lose };
            *count = count.wrapping_add_signed(sign);
        }
    }

    /// The transition whose elimination adds the fewest rows.
    fn cheapest(&self) -> Option<u32> {
        let left = self.0.iter().zip(0..).filter(|((gain, lose), _)| gain + lose > 0);
        left.min_by_key(|((gain, lose), _)| (gain * lose) as i64 - (gain + lose) as i64)
            .map(|(_, transition)| transition)
    }
}

/// Replaces the rows that a transition changes by their combinations.
fn eliminate(transition: u32, rows: &mut Vec<Row>, wanted: Wanted, limit: usize, counts: &mut Counts, work: &mut u64) {
    let (changed, kept): (Vec<Row>, Vec<Row>) =
        std::mem::take(rows).into_iter().partition(|row| row.change(transition) != 0);
    changed.iter().for_each(|row| counts.add(row, -1));
    *rows = kept;
    *work += rows.len() as u64;
    let (gain, lose): (Vec<&Row>, Vec<&Row>) = changed.iter().partition(|row| row.change(transition) > 0);
    let mut fresh: Vec<Row> = Vec::new();
    for one in &gain {
        for other in &lose {
            if *work > WORK || wanted == Wanted::OneToken && one.tokens + other.tokens > 1 {
                continue;
            }
            let Some(row) = one.combine(other, transition).filter(|row| row.is(wanted)) else { continue };
            *work += (row.weights.len() + row.changes.len() + rows.len() + fresh.len()) as u64;
            if !rows.iter().chain(&fresh).any(|smaller| row.holds_support_of(smaller)) {
                fresh.retain(|larger| !larger.holds_support_of(&row));
                fresh.push(row);
            }
        }
    }
    // Small supports are the more useful ones.
    fresh.sort_by_key(|row| row.weights.len());
    fresh.truncate(limit.saturating_sub(rows.len()));
    fresh.iter().for_each(|row| counts.add(row, 1));
    rows.append(&mut fresh);
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
