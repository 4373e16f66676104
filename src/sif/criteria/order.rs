//! The order of tests: few inputs switched from one to the next.

use fixedbitset::FixedBitSet;

/// Most tests that are put in order by exchanging pieces; more are only taken each after its nearest.
const MAX_EXCHANGED: usize = 1500;

/// Most passes over all pieces.
const MAX_PASSES: usize = 8;

/// An order of tests, as their positions: the first is the nearest to rest, each next the nearest to the one before (nearest
/// neighbour), and then pieces are turned round as long as that saves switching (2-opt: Croes, "A method for solving
/// traveling-salesman problems", 1958).
#[must_use]
pub fn ordered(tests: &[FixedBitSet], rest: &FixedBitSet) -> Vec<usize> {
    let distance = |a: usize, b: usize| tests[a].symmetric_difference_count(&tests[b]);
    let Some(first) = (0..tests.len()).min_by_key(|&test| tests[test].symmetric_difference_count(rest)) else {
        return Vec::new();
    };
    let mut left: Vec<usize> = (0..tests.len()).filter(|&test| test != first).collect();
    let mut order = vec![first];
    let mut last = first;
    while let Some(at) = (0..left.len()).min_by_key(|&at| (distance(last, left[at]), left[at])) {
        last = left.swap_remove(at);
        order.push(last);
    }
    if order.len() <= MAX_EXCHANGED {
        exchange(&mut order, distance);
    }
    order
}

/// Turns pieces round; the first test stays.
fn exchange(order: &mut [usize], distance: impl Fn(usize, usize) -> usize) {
    for _ in 0..MAX_PASSES {
        let mut is_better = false;
        for from in 1..order.len() {
            for to in from + 1..order.len() {
                let next = order.get(to + 1).copied();
                let cost = |a: usize, b: Option<usize>| b.map_or(0, |b| distance(a, b));
                let before = distance(order[from - 1], order[from]) + cost(order[to], next);
                let after = distance(order[from - 1], order[to]) + cost(order[from], next);
                if after < before {
                    order[from..=to].reverse();
                    is_better = true;
                }
            }
        }
        if !is_better {
            return;
        }
    }
}
