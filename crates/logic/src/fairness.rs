//! Fair paths: those that visit some sets of states infinitely often (weak fairness), and one set if they visit another
//! infinitely often (strong fairness). A finite path that ends is always fair.
//!
//! Finite prefixes make no difference, so fair paths are those into a strongly connected component that satisfies every
//! constraint (Emerson and Lei 1987). A component with states of a premise and none of its goal is searched again
//! without the states of the premise.

mod assumed;

pub use assumed::{Constraint, FairnessAssumption, FairnessText, Recurrence};

use std::sync::atomic::AtomicBool;

use fixedbitset::FixedBitSet;

use super::reach::leading_to;
use petril_search::{Components, Graph, components};

/// Fairness constraints on the paths of a graph, as sets of its states.
#[derive(Clone, Debug, Default)]
pub struct Constraints {
    /// Weak constraints: sets that fair paths visit infinitely often.
    pub weak: Vec<FixedBitSet>,
    /// Strong constraints (premise, goal): fair paths that visit the premise infinitely often also visit the goal
    /// infinitely often.
    pub strong: Vec<(FixedBitSet, FixedBitSet)>,
}

/// Fairness constraints on the paths of a graph, and the states from which fair paths begin.
#[derive(Clone, Debug)]
pub struct Fairness {
    constraints: Constraints,
    surely: FixedBitSet,
    possibly: FixedBitSet,
}

impl Fairness {
    /// Computes the states of a graph from which there are paths that satisfy all constraints.
    #[must_use]
    pub fn on(graph: &Graph, constraints: Constraints) -> Self {
        let mut all = FixedBitSet::with_capacity(graph.len());
        all.insert_range(..);
        let mut ends = endings(graph, &all, Some(&constraints));
        let go_on = AtomicBool::new(false);
        let surely = leading_to(graph, &ends, &go_on);
        let mut possibly = surely.clone();
        if !graph.is_complete() {
            ends.union_with(&graph.open());
            possibly = leading_to(graph, &ends, &go_on);
        }
        Self { constraints, surely, possibly }
    }

    /// Fairness constraints.
    #[must_use]
    pub fn constraints(&self) -> &Constraints {
        &self.constraints
    }

    /// States from which there is a fair path, whatever the missing steps are.
    #[must_use]
    pub fn surely(&self) -> &FixedBitSet {
        &self.surely
    }

    /// States from which there may be a fair path. On a complete graph the same as [`Self::surely`].
    #[must_use]
    pub fn possibly(&self) -> &FixedBitSet {
        &self.possibly
    }
}

impl Constraints {
    /// Goals of strong constraints that a cycle through these states violates.
    pub(super) fn owed(&self, round: &[u32]) -> impl Iterator<Item = &FixedBitSet> {
        let met = |set: &FixedBitSet| round.iter().any(|&state| set.contains(state as usize));
        let owed = self.strong.iter().filter(move |(premise, goal)| met(premise) && !met(goal));
        owed.map(|(_, goal)| goal)
    }

    /// States of the strongly connected components within a set that contain a fair infinite path.
    pub(super) fn rounds(&self, graph: &Graph, within: &FixedBitSet) -> FixedBitSet {
        let mut found = FixedBitSet::with_capacity(graph.len());
        let mut rest = within.clone();
        loop {
            let parts = components(graph, &rest);
            let mut good = parts.cyclic.clone();
            self.weak.iter().for_each(|set| good.intersect_with(&visited(&parts, &rest, set)));
            // Components with a premise and without its goal, and the states of these premises.
            let mut owing = FixedBitSet::with_capacity(parts.count);
            let mut left_out = FixedBitSet::with_capacity(graph.len());
            for (premise, goal) in &self.strong {
                let paid = visited(&parts, &rest, goal);
                for state in rest.intersection(premise) {
                    let part = parts.of[state] as usize;
                    if good.contains(part) && !paid.contains(part) {
                        owing.insert(part);
                        left_out.insert(state);
                    }
                }
            }
            let mut next = FixedBitSet::with_capacity(graph.len());
            for state in rest.ones().filter(|&state| good.contains(parts.of[state] as usize)) {
                if !owing.contains(parts.of[state] as usize) {
                    found.insert(state);
                } else if !left_out.contains(state) {
                    next.insert(state);
                }
            }
            if next.is_clear() {
                return found;
            }
            rest = next;
        }
    }
}

/// Components of `within` that contain a state of a set.
fn visited(parts: &Components, within: &FixedBitSet, set: &FixedBitSet) -> FixedBitSet {
    let mut visited = FixedBitSet::with_capacity(parts.count);
    within.intersection(set).for_each(|state| visited.insert(parts.of[state] as usize));
    visited
}

/// States on fair cycles that stay in `within`, and states of it in which paths end. In the subgraph of these states
/// alone, the strongly connected components are those of the fair cycles.
pub(super) fn endings(graph: &Graph, within: &FixedBitSet, constraints: Option<&Constraints>) -> FixedBitSet {
    let mut endings = match constraints {
        Some(constraints) => constraints.rounds(graph, within),
        None => {
            let parts = components(graph, within);
            let mut cyclic = FixedBitSet::with_capacity(graph.len());
            cyclic.extend(within.ones().filter(|&state| parts.on_cycle(state as u32)));
            cyclic
        }
    };
    let open = graph.open();
    let ends = |&state: &usize| graph.successors(state as u32).is_empty() && !open.contains(state);
    endings.extend(within.ones().filter(ends));
    endings
}
