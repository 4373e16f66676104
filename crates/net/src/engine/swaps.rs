//! Commuting transitions (as with sleep sets): firings that are redundant because another order of the same firings
//! leads to the same marking.
//!
//! Let a state x be first reached by firing b in a state s. If every marking that can fire b and then a can also fire a
//! and then b, the successor of x by a is also the successor by b of the state y that a leads to from s. So if a comes
//! before b in the order of the transitions, a need not be fired in x. No state is lost, and none is found later than
//! without this:
//!
//! Suppose every state within distance d + 1 is found at its distance, and let z be at distance d + 2, by firing a in a
//! state x at distance d + 1. If that firing is left out, x was reached by b from s at distance d, and y is within
//! distance d + 1. Its distance is exactly d + 1, since z is its successor by b, which comes after a. If that firing is
//! left out too, the argument is repeated with a later transition, so it ends with a firing that is not left out.

use super::model::{Rule, Touch};

/// Commuting transitions: for each transition by which a state was reached, the transitions to be fired there.
pub(super) enum Swaps {
    /// A row of bits for each transition, and one more for states not reached by a transition.
    Rows(Vec<u64>),
    /// For each transition, the earlier ones to be fired, as the non-zero words of the row of bits; `None` if all are
    /// to be fired, because there were too many to examine.
    Lists(Vec<Option<Words>>),
}

/// Non-zero words of a row of bits, each with its position.
type Words = Box<[(u32, u64)]>;

/// Total size of all rows, in words, above which there are lists: 2 MiB.
const ROWS: usize = 1 << 18;

/// Maximum number of pairs of transitions sharing a place that are examined.
const PAIRS: usize = 20_000_000;

impl Swaps {
    /// Finds the commuting transitions of a net; sets of transitions have `width` words.
    pub(super) fn of(rules: &[Rule], places: usize, width: usize) -> Self {
        let mut touching: Vec<Vec<usize>> = vec![Vec::new(); places];
        for (transition, rule) in rules.iter().enumerate() {
            rule.iter().for_each(|touch| touching[touch.place].push(transition));
        }
        // Transitions that share no place with b commute with it; each of the others is examined.
        let mut left = PAIRS;
        let fired = |(b, rule): (usize, &Rule)| {
            left = left.saturating_sub(rule.iter().map(|touch| touching[touch.place].len()).sum());
            let near = rule.iter().flat_map(|touch| &touching[touch.place]).copied().filter(|&a| a < b);
            let mut fired: Vec<usize> = if left > 0 { near.collect() } else { return None };
            fired.sort_unstable();
            fired.dedup();
            fired.retain(|&a| !swappable(rule, &rules[a]));
            Some(fired)
        };
        let fired = rules.iter().enumerate().map(fired);
        if (rules.len() + 1) * width <= ROWS {
            let mut rows = vec![u64::MAX; (rules.len() + 1) * width];
            for ((b, fired), row) in fired.enumerate().zip(rows.chunks_exact_mut(width)) {
                let Some(fired) = fired else { continue };
                (0..b).for_each(|a| row[a / 64] &= !(1 << (a % 64)));
                fired.into_iter().for_each(|a| row[a / 64] |= 1 << (a % 64));
            }
            Self::Rows(rows)
        } else {
            Self::Lists(fired.map(|fired| Some(words(&fired?))).collect())
        }
    }

    /// Restricts `set` to the transitions to be fired in a state reached by `via`.
    #[inline(always)]
    pub(super) fn restrict(&self, via: u32, set: &mut [u64]) {
        match self {
            Self::Rows(rows) => {
                let row = &rows[via as usize * set.len()..][..set.len()];
                set.iter_mut().zip(row).for_each(|(word, row)| *word &= row);
            }
            Self::Lists(lists) => {
                if let Some(Some(list)) = lists.get(via as usize) {
                    restrict(list, via, set);
                }
            }
        }
    }

    /// Memory in use, in bytes.
    pub(super) fn bytes(&self) -> u64 {
        match self {
            Self::Rows(rows) => rows.capacity() as u64 * 8,
            Self::Lists(lists) => {
                lists.iter().map(|list| 16 + 16 * list.as_ref().map_or(0, |list| list.len() as u64)).sum()
            }
        }
    }
}

/// Set of ascending numbers as non-zero words with their positions.
fn words(numbers: &[usize]) -> Box<[(u32, u64)]> {
    let same_word = numbers.chunk_by(|a, b| a / 64 == b / 64);
    let word = |numbers: &[usize]| {
        ((numbers[0] / 64) as u32, numbers.iter().fold(0, |word, number| word | 1 << (number % 64)))
    };
    same_word.map(word).collect()
}

#[inline(never)]
fn restrict(list: &[(u32, u64)], via: u32, set: &mut [u64]) {
    let (last, bit) = (via as usize / 64, via % 64);
    let mut next = 0;
    for &(position, kept) in list {
        let position = position as usize;
        set[next..position.min(last)].fill(0);
        // The word of `via` also contains later transitions.
        set[position] &= if position == last { kept | u64::MAX << bit } else { kept };
        next = position + 1;
    }
    if next <= last {
        set[next..last].fill(0);
        set[last] &= u64::MAX << bit;
    }
}

/// Whether a marking that can fire `b` and then `a` can also fire `a` and then `b`.
fn swappable(b: &Rule, a: &Rule) -> bool {
    // Tokens that a place needs for one firing followed by another.
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

#[cfg(test)]
mod tests {
    use super::{Swaps, restrict, words};

    #[test]
    fn lists_say_what_rows_say() {
        for via in [0, 1, 63, 64, 65, 127, 128, 191] {
            for step in [1, 3, 64, 100, 1000] {
                let kept: Vec<usize> = (0..via).rev().step_by(step).collect::<Vec<usize>>().into_iter().rev().collect();
                let mut set = [u64::MAX; 3];
                restrict(&words(&kept), via as u32, &mut set);
                let has = |transition: usize| set[transition / 64] >> (transition % 64) & 1 == 1;
                assert!(
                    (0..192).all(|transition| has(transition) == (transition >= via || kept.contains(&transition)))
                );
            }
        }
        let mut set = [5];
        Swaps::Lists(Vec::new()).restrict(0, &mut set);
        assert_eq!(set, [5], "a state that was not reached by any transition");
    }
}
