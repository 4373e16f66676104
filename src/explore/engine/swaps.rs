//! Firings that need not be tried because another order of the same firings leads to the same marking.
//!
//! Let a state x be first reached by firing b in a state s. If whatever can fire b and then a can also fire a and then b, the
//! successor of x by a is also the successor by b of the state y that a leads to from s. So if a stands before b in the order
//! of the transitions, a need not be fired in x. Nothing is lost, and no state is found later than without this:
//!
//! Suppose every state within distance d + 1 is found at its distance, and let z be at distance d + 2, by firing a in a state
//! x at distance d + 1. If that firing is left out, x was reached by b from s at distance d, and y is within distance d + 1; it
//! cannot be nearer than d + 1, as z is its successor by b, which stands behind a. If that firing is left out too, the argument
//! goes on with a transition that stands further behind, so it ends with a firing that is not left out.

use super::model::{Rule, Touch};

/// For each transition by which a state was reached, the transitions to be fired there.
pub(super) struct Swaps {
    /// A row for each transition, and one more for states that were not reached by any.
    fired: Vec<u64>,
}

/// Transitions above this number would make the table too large; nothing is left out then.
const MOST: usize = 8192;

impl Swaps {
    /// Rows have `width` words.
    pub(super) fn of(rules: &[Rule], places: usize, width: usize) -> Self {
        if rules.len() > MOST {
            return Self { fired: Vec::new() };
        }
        let mut fired = vec![u64::MAX; (rules.len() + 1) * width];
        let mut touching: Vec<Vec<usize>> = vec![Vec::new(); places];
        for (transition, rule) in rules.iter().enumerate() {
            rule.iter().for_each(|touch| touching[touch.place].push(transition));
        }
        for (b, rule) in rules.iter().enumerate() {
            let row = &mut fired[b * width..(b + 1) * width];
            // Those before b that share no place with it can be swapped with it; of the others each is examined.
            (0..b).for_each(|a| row[a / 64] &= !(1 << (a % 64)));
            for &a in rule.iter().flat_map(|touch| &touching[touch.place]).filter(|&&a| a < b) {
                if !swappable(rule, &rules[a]) {
                    row[a / 64] |= 1 << (a % 64);
                }
            }
        }
        Self { fired }
    }

    /// Bytes in use.
    pub(super) fn bytes(&self) -> u64 {
        self.fired.capacity() as u64 * 8
    }

    /// Leaves in `set` what is to be fired in a state reached by `via`.
    #[inline(always)]
    pub(super) fn restrict(&self, via: u32, set: &mut [u64]) {
        let start = via as usize * set.len();
        if let Some(row) = self.fired.get(start..start + set.len()) {
            for (word, row) in set.iter_mut().zip(row) {
                *word &= row;
            }
        }
    }
}

/// Whether a marking that can fire `b` and then `a` can also fire `a` and then `b`.
fn swappable(b: &Rule, a: &Rule) -> bool {
    // What a place must have for one firing and then another.
    let needed = |first: Touch, second: Touch| (first.pre as i64).max(second.pre as i64 - first.change());
    let enough = |place: usize| {
        let at = |rule: &Rule| {
            let found = rule.binary_search_by_key(&place, |touch| touch.place);
            found.map_or(Touch { place, pre: 0, post: 0 }, |found| rule[found])
        };
        needed(at(b), at(a)) >= needed(at(a), at(b))
    };
    b.iter().chain(a).all(|touch| enough(touch.place))
}
