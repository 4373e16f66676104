//! The largest siphon and the largest trap within a set of places. Both exist, since unions of siphons are siphons and
//! unions of traps are traps; both are found in time linear in the size of the net.

use fixedbitset::FixedBitSet;

use super::flow::Flow;

/// Computes the largest trap within a set of places, by removing, one after another, places that a transition takes
/// tokens from or reads without putting any on the set.
#[must_use]
pub fn largest_trap(flow: &Flow, within: &FixedBitSet) -> FixedBitSet {
    let mut left = within.clone();
    // For each transition, the number of places of the set in its postset.
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

/// Computes the largest siphon within a set of places, by removing, one after another, places that a transition puts
/// tokens on without needing any of the set.
#[must_use]
pub fn largest_siphon(flow: &Flow, within: &FixedBitSet) -> FixedBitSet {
    largest_trap(&flow.reversed(), within)
}
