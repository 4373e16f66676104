//! The largest siphon and the largest trap within a set of places. Both exist, since unions of siphons are siphons and unions of
//! traps are traps; both are found in time proportional to the net.

use fixedbitset::FixedBitSet;

use super::flow::Flow;

/// The largest trap within a set of places: what is left when places whose tokens some transition needs without putting any
/// on the set are taken away, one after another.
#[must_use]
pub fn largest_trap(flow: &Flow, within: &FixedBitSet) -> FixedBitSet {
    let mut left = within.clone();
    // How many places of the set each transition puts tokens on.
    let mut supports: Vec<usize> = (0..flow.transitions())
        .map(|id| flow.outputs[id].iter().filter(|&&place| left.contains(place as usize)).count())
        .collect();
    let mut without: Vec<usize> = (0..flow.transitions()).filter(|&id| supports[id] == 0).collect();
    while let Some(id) = without.pop() {
        for place in flow.inputs[id].iter().map(|&place| place as usize) {
            if left.contains(place) {
                left.set(place, false);
                for producer in flow.producers[place].iter().map(|&id| id as usize) {
                    supports[producer] -= 1;
                    if supports[producer] == 0 {
                        without.push(producer);
                    }
                }
            }
        }
    }
    left
}

/// The largest siphon within a set of places: what is left when places that some transition puts tokens on without needing any
/// of the set are taken away, one after another.
#[must_use]
pub fn largest_siphon(flow: &Flow, within: &FixedBitSet) -> FixedBitSet {
    largest_trap(&flow.reversed(), within)
}
