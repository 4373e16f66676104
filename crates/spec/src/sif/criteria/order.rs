//! Order of tests: few inputs switched from one test to the next.

use fixedbitset::FixedBitSet;

use petril_check::simulate::Lots;

/// Upper bound on tests ordered by local search; more are only ordered by nearest neighbour.
const MAX_EXCHANGED: usize = 1000;

/// Upper bound on tests for which segments are also moved (Or-opt).
const MAX_SHIFTED: usize = 250;

/// Upper bound on passes over all segments.
const MAX_PASSES: usize = 8;

/// Upper bounds on random restarts, and on pairs of tests examined for them.
const MAX_ROUNDS: usize = 60;
const MAX_WORK: usize = 100_000;

/// Longest segment that is moved.
const MAX_MOVED: usize = 3;

/// An order of tests, as positions. The first test is the one nearest to rest, each next one the nearest to its
/// predecessor (nearest neighbour); then segments are reversed and moved as long as that saves switching (2-opt: Croes,
/// "A method for solving traveling-salesman problems", 1958; Or-opt).
#[must_use]
pub fn ordered(tests: &[FixedBitSet], rest: &FixedBitSet) -> Vec<usize> {
    let count = tests.len();
    let Some(first) = (0..count).min_by_key(|&test| tests[test].symmetric_difference_count(rest)) else {
        return Vec::new();
    };
    let words = different(tests);
    let width = words.len() / count;
    let of = |test: usize| &words[test * width..][..width];
    let distance = |a: usize, b: usize| of(a).iter().zip(of(b)).map(|(a, b)| (a ^ b).count_ones()).sum::<u32>();
    let mut left: Vec<usize> = (0..count).filter(|&test| test != first).collect();
    let mut order = vec![first];
    let mut last = first;
    while let Some(at) = (0..left.len()).min_by_key(|&at| (distance(last, left[at]), left[at])) {
        last = left.swap_remove(at);
        order.push(last);
    }
    if count <= MAX_EXCHANGED {
        exchange(&mut order, distance);
        // Random double-bridge moves lead out of local optima (Martin, Otto and Felten, 1991).
        let length = |order: &[usize]| order.windows(2).map(|pair| distance(pair[0], pair[1])).sum::<u32>();
        let mut lots = Lots::new(4);
        let (mut shortest, inner) = (length(&order), count.saturating_sub(1) as u128);
        for _ in 0..if count < 5 { 0 } else { (MAX_WORK / (count * count)).min(MAX_ROUNDS) } {
            let mut cuts = [0; 3].map(|_| 1 + lots.below(inner) as usize);
            cuts.sort_unstable();
            let [a, b, c] = cuts;
            let mut other = [&order[..a], &order[b..c], &order[a..b], &order[c..]].concat();
            exchange(&mut other, distance);
            if length(&other) < shortest {
                (shortest, order) = (length(&other), other);
            }
        }
    }
    order
}

/// Local search: improves segments as long as that saves switching.
fn exchange(order: &mut [usize], distance: impl Fn(usize, usize) -> u32 + Copy) {
    for _ in 0..MAX_PASSES {
        let is_turned = turn(order, distance);
        let is_shifted = order.len() <= MAX_SHIFTED && shift(order, distance);
        if !is_shifted && !is_turned {
            return;
        }
    }
}

/// 2-opt: reverses segments where that saves switching; the first test stays. Returns whether the order improved.
fn turn(order: &mut [usize], distance: impl Fn(usize, usize) -> u32) -> bool {
    let mut is_better = false;
    for from in 1..order.len() {
        for to in from + 1..order.len() {
            let next = order.get(to + 1);
            let cost = |a: usize| next.map_or(0, |b| distance(a, *b));
            let before = distance(order[from - 1], order[from]) + cost(order[to]);
            let after = distance(order[from - 1], order[to]) + cost(order[from]);
            if after < before {
                order[from..=to].reverse();
                is_better = true;
            }
        }
    }
    is_better
}

/// Or-opt: moves short segments forward or back, reversed or not, where that saves switching. Returns whether the order
/// improved.
fn shift(order: &mut [usize], distance: impl Fn(usize, usize) -> u32) -> bool {
    let mut is_better = false;
    for length in 1..=MAX_MOVED {
        for from in 1..(order.len() + 1).saturating_sub(length) {
            let end = from + length;
            let gap = |a: usize, b: Option<usize>| b.map_or(0, |b| distance(a, b));
            let (first, last) = (order[from], order[end - 1]);
            let after = order.get(end).copied();
            let saved = distance(order[from - 1], first) + gap(last, after);
            let closed = gap(order[from - 1], after);
            let places = (1..=order.len()).filter(|place| *place < from || *place > end);
            let best = places
                .flat_map(|place| {
                    let (a, b) = (order[place - 1], order.get(place).copied());
                    let open = gap(a, b);
                    let straight = distance(a, first) + gap(last, b);
                    let turned = distance(a, last) + gap(first, b);
                    [(straight + closed, open, place, false), (turned + closed, open, place, true)]
                })
                .filter(|(cost, open, ..)| *cost < saved + open)
                .max_by_key(|(cost, open, ..)| saved + open - cost);
            if let Some((.., place, is_turned)) = best {
                if is_turned {
                    order[from..end].reverse();
                }
                if place > end {
                    order[from..place].rotate_left(length);
                } else {
                    order[place..end].rotate_right(length);
                }
                is_better = true;
            }
        }
    }
    is_better
}

/// Inputs that differ between tests, packed: an equal number of words for each test.
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
