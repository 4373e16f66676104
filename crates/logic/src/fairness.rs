//! Which paths count: those that come again and again to some sets of states (weak fairness), and to one set if they come
//! again and again to another (strong fairness). A path that ends counts always.
//!
//! What a path does only finitely often makes no difference, so the paths that count are those into a strongly connected part
//! that meets every constraint (Emerson and Lei 1987). A part that has states of a premise and none of its goal is looked
//! through once more without the premise.

mod assumed;

pub use assumed::{Constraint, FairnessAssumption, FairnessText, Recurrence};

use std::sync::atomic::AtomicBool;

use fixedbitset::FixedBitSet;

use super::label::leading_to;
use petril_search::{Components, Graph, components};

/// Constraints on the paths of one graph, as sets of its states.
#[derive(Clone, Debug, Default)]
pub struct Constraints {
    /// Paths come to each of these again and again.
    pub weak: Vec<FixedBitSet>,
    /// Paths that come to the first again and again come so to the second.
    pub strong: Vec<(FixedBitSet, FixedBitSet)>,
}

/// Constraints on the paths of one graph, and where paths that meet them begin.
#[derive(Clone, Debug)]
pub struct Fairness {
    constraints: Constraints,
    surely: FixedBitSet,
    possibly: FixedBitSet,
}

impl Fairness {
    /// The paths of a graph that meet all constraints count.
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

    /// The constraints.
    #[must_use]
    pub fn constraints(&self) -> &Constraints {
        &self.constraints
    }

    /// The states from which a path counts, whatever the missing steps are.
    #[must_use]
    pub fn surely(&self) -> &FixedBitSet {
        &self.surely
    }

    /// The states from which a path may count. On a complete graph they are the same.
    #[must_use]
    pub fn possibly(&self) -> &FixedBitSet {
        &self.possibly
    }
}

impl Constraints {
    /// The goals that going round these states for ever owes.
    pub(super) fn owed(&self, round: &[u32]) -> impl Iterator<Item = &FixedBitSet> {
        let met = |set: &FixedBitSet| round.iter().any(|&state| set.contains(state as usize));
        let owed = self.strong.iter().filter(move |(premise, goal)| met(premise) && !met(goal));
        owed.map(|(_, goal)| goal)
    }

    /// The states of the strongly connected parts inside a set in which a path can go round for ever and meet everything.
    pub(super) fn rounds(&self, graph: &Graph, within: &FixedBitSet) -> FixedBitSet {
        let mut found = FixedBitSet::with_capacity(graph.len());
        let mut rest = within.clone();
        loop {
            let parts = components(graph, &rest);
            let mut good = parts.cyclic.clone();
            self.weak.iter().for_each(|set| good.intersect_with(&visited(&parts, &rest, set)));
            // Parts with a premise and without its goal; and the states of such premises.
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

/// The parts of `within` that have a state of a set.
fn visited(parts: &Components, within: &FixedBitSet, set: &FixedBitSet) -> FixedBitSet {
    let mut visited = FixedBitSet::with_capacity(parts.count);
    within.intersection(set).for_each(|state| visited.insert(parts.of[state] as usize));
    visited
}

/// The states in which a path that stays in `within` can go round for ever, meeting what is asked for, and those where paths
/// end. In the graph of these states alone, the strongly connected parts are those that the rounds go through.
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
