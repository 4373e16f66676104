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
    let count = tests.len();
    let Some(first) = (0..count).min_by_key(|&test| tests[test].symmetric_difference_count(rest)) else {
        return Vec::new();
    };
    let tests = &different(tests);
    let width = tests.len() / count;
    let of = |test: usize| &tests[test * width..][..width];
    let distance = |a: usize, b: usize| of(a).iter().zip(of(b)).map(|(a, b)| (a ^ b).count_ones()).sum::<u32>();
    let mut left: Vec<usize> = (0..count).filter(|&test| test != first).collect();
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
fn exchange(order: &mut [usize], distance: impl Fn(usize, usize) -> u32) {
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

/// The inputs that are not the same in all tests, packed: so many words for each test.
fn different(tests: &[FixedBitSet]) -> Vec<u64> {
    let mut seen = tests.first().cloned().unwrap_or_default();
    let mut always = seen.clone();
    for test in tests {
        seen.union_with(test);
        always.intersect_with(test);
    }
    seen.difference_with(&always);
    let width = seen.count_ones(..).div_ceil(64).max(1);
    let mut words = vec![0; tests.len() * width];
    for (test, words) in tests.iter().zip(words.chunks_mut(width)) {
        let bits = seen.ones().enumerate().filter(|(_, input)| test.contains(*input));
        bits.for_each(|(bit, _)| words[bit / 64] |= 1 << (bit % 64));
    }
    words
}
