//! Labelling: the states that satisfy each node, by the classical CTL fixpoints (Clarke, Emerson and Sistla 1986).
//!
//! A path ends only in a state without steps; there AX g is true and EX g is false, and W is satisfied. If a graph is
//! not complete, a state is in a set only if the node holds whatever the missing steps are. So a formula holds if the
//! initial states are in its set, is violated if one of them is in the set of its negation, and is undecided otherwise.
//!
//! Under fairness, E and A quantify over fair paths. So a finite witness must lead to a state from which there is a
//! fair path. State formulas are unaffected.

use std::borrow::Cow;
use std::sync::atomic::{AtomicBool, Ordering};

use fixedbitset::FixedBitSet;
use rayon::prelude::*;

use super::bound::Bound;
use super::dag::{Dag, Node, NodeId};
use super::fairness::{Fairness, endings};
use super::formula::Quantifier;
use super::reach::leading_through;
use super::sweep::grow;
use petril_search::Graph;

/// Labelling of a graph: the states that satisfy each node of a [`Dag`].
pub struct Labels {
    sets: Vec<FixedBitSet>,
}

impl Labels {
    /// States that satisfy a node.
    #[must_use]
    pub fn of(&self, node: NodeId) -> &FixedBitSet {
        &self.sets[node.index()]
    }
}

/// Labels every node. `holds` evaluates a state formula in a state. With `fairness`, quantifiers range over fair paths.
pub fn label(
    graph: &Graph,
    dag: &Dag,
    holds: &(dyn Fn(&Bound, u32) -> bool + Sync),
    fairness: Option<&Fairness>,
) -> Labels {
    let never = AtomicBool::new(false);
    label_until(graph, dag, holds, fairness, &never).unwrap_or(Labels { sets: Vec::new() })
}

/// Labels every node as [`label`] does. `None` if `stopping` is set meanwhile.
pub fn label_until(
    graph: &Graph,
    dag: &Dag,
    holds: &(dyn Fn(&Bound, u32) -> bool + Sync),
    fairness: Option<&Fairness>,
    stopping: &AtomicBool,
) -> Option<Labels> {
    let holding = |formula: &Bound, negated| set_where(graph.len(), |state| holds(formula, state) != negated);
    let mut sets = Vec::with_capacity(dag.nodes().len());
    Labeller { graph, open: &graph.open(), fairness, stopping }.label(dag, &holding, &mut sets);
    (!stopping.load(Ordering::Relaxed)).then_some(Labels { sets })
}

/// Labels every node as [`label`] does, without fairness; `holding` gives the states in which a state formula holds, or
/// its negation if the second argument is true. `None` if `stopping` is set meanwhile.
pub fn label_from(
    graph: &Graph,
    dag: &Dag,
    holding: &dyn Fn(&Bound, bool) -> FixedBitSet,
    stopping: &AtomicBool,
) -> Option<Labels> {
    let mut sets = Vec::with_capacity(dag.nodes().len());
    Labeller { graph, open: &graph.open(), fairness: None, stopping }.label(dag, holding, &mut sets);
    (!stopping.load(Ordering::Relaxed)).then_some(Labels { sets })
}

struct Labeller<'a> {
    graph: &'a Graph,
    open: &'a FixedBitSet,
    fairness: Option<&'a Fairness>,
    /// Cancellation flag: once set, the results are not used.
    stopping: &'a AtomicBool,
}

impl Labeller<'_> {
    fn label(&self, dag: &Dag, holding: &dyn Fn(&Bound, bool) -> FixedBitSet, sets: &mut Vec<FixedBitSet>) {
        for node in dag.nodes() {
            if self.stopping.load(Ordering::Relaxed) {
                return;
            }
            let set = |id: &NodeId| &sets[id.index()];
            let labelled = match node {
                Node::State { formula, negated } => holding(formula, *negated),
                Node::And(f, g) => set(f) & set(g),
                Node::Or(f, g) => set(f) | set(g),
                Node::Next(Quantifier::Some, f) => self.exists_next(set(f)),
                Node::Next(Quantifier::All, f) => self.all_next(set(f)),
                Node::Until(Quantifier::Some, f, g) => self.exists_until(set(f), set(g)),
                Node::Until(Quantifier::All, f, g) => self.all_until(set(f), set(g)),
                Node::WeakUntil(Quantifier::Some, f, g) => self.exists_weak_until(set(f), set(g)),
                Node::WeakUntil(Quantifier::All, f, g) => self.all_weak_until(set(f), set(g)),
            };
            sets.push(labelled);
        }
    }

    /// Rows that satisfy a test.
    fn rows_where(&self, test: impl Fn(&[u32]) -> bool + Sync) -> FixedBitSet {
        set_where(self.graph.rows(), |row| test(self.graph.row(row)))
    }

    fn exists_next(&self, f: &FixedBitSet) -> FixedBitSet {
        let f = &self.that_count(f);
        let rows = self.rows_where(|row| row.iter().any(|&next| f.contains(next as usize)));
        let some = |state| self.graph.row_of(state).is_some_and(|row| rows.contains(row as usize));
        set_where(self.graph.len(), some)
    }

    fn all_next(&self, f: &FixedBitSet) -> FixedBitSet {
        let mut f = Cow::Borrowed(f);
        if let Some(fairness) = self.fairness {
            f.to_mut().union_with(&complement(fairness.possibly()));
        }
        let rows = self.rows_where(|row| row.iter().all(|&next| f.contains(next as usize)));
        let all = |state| self.graph.row_of(state).is_some_and(|row| rows.contains(row as usize));
        set_where(self.graph.len(), |state| !self.open.contains(state as usize) && all(state))
    }

    /// States of a set from which there is a fair path.
    fn that_count<'s>(&self, set: &'s FixedBitSet) -> Cow<'s, FixedBitSet> {
        self.fairness.map_or(Cow::Borrowed(set), |fairness| Cow::Owned(set & fairness.surely()))
    }

    fn exists_until(&self, f: &FixedBitSet, g: &FixedBitSet) -> FixedBitSet {
        self.way(f, &self.that_count(g))
    }

    /// States from which known steps lead through states with f to a state with g, whether or not a fair path continues
    /// there.
    fn way(&self, f: &FixedBitSet, g: &FixedBitSet) -> FixedBitSet {
        leading_through(self.graph, f, g, self.stopping)
    }

    /// Adds the states of `within` all of whose known steps lead into the set, and which have a step, known or unknown.
    fn forced(&self, set: FixedBitSet, within: &FixedBitSet) -> FixedBitSet {
        grow(self.graph, set, within, self.stopping, &|set, state| {
            let row = self.graph.successors(state);
            let all = row.iter().all(|&next| set.contains(next as usize));
            all && (!row.is_empty() || self.open.contains(state as usize))
        })
    }

    fn all_weak_until(&self, f: &FixedBitSet, g: &FixedBitSet) -> FixedBitSet {
        // A[f W g] = ¬E[¬g U ¬(f ∨ g)]
        let not_g = complement(g);
        let bad = self.bad(f, g, &not_g);
        complement(&self.way(&not_g, &bad))
    }

    /// States without f and g from which there may be a fair path. An unknown step counts as one to such a state.
    fn bad(&self, f: &FixedBitSet, g: &FixedBitSet, not_g: &FixedBitSet) -> FixedBitSet {
        let mut bad = complement(&(f | g));
        if let Some(fairness) = self.fairness {
            bad.intersect_with(fairness.possibly());
        }
        bad.union_with(&(self.open & not_g));
        bad
    }

    fn all_until(&self, f: &FixedBitSet, g: &FixedBitSet) -> FixedBitSet {
        if self.fairness.is_some() {
            // A[f U g] = ¬(E[¬g U ¬(f ∨ g)] ∨ E G ¬g)
            let not_g = complement(g);
            let mut bad = self.bad(f, g, &not_g);
            bad.union_with(&endings(self.graph, &not_g, self.fairness.map(Fairness::constraints)));
            return complement(&self.way(&not_g, &bad));
        }
        let mut within = f.clone();
        within.difference_with(self.open);
        self.forced(g.clone(), &within)
    }

    fn exists_weak_until(&self, f: &FixedBitSet, g: &FixedBitSet) -> FixedBitSet {
        if self.fairness.is_some() {
            // E[f W g] = E[f U (g ∨ E G f)], with E over fair paths.
            let mut goal = endings(self.graph, f, self.fairness.map(Fairness::constraints));
            goal.union_with(&self.that_count(g));
            return self.way(f, &goal);
        }
        // Complement: states without f and g, or with f and steps only to such states.
        let neither = complement(&(f | g));
        let mut within = f.clone();
        within.difference_with(g);
        complement(&self.forced(neither, &within))
    }
}

fn complement(set: &FixedBitSet) -> FixedBitSet {
    let mut complement = set.clone();
    complement.toggle_range(..);
    complement
}

/// Set of the numbers below `n` that satisfy a test, computed on all processors.
fn set_where(n: usize, test: impl Fn(u32) -> bool + Sync) -> FixedBitSet {
    const BITS: usize = usize::BITS as usize;
    let block = |first: usize| {
        let numbers = first..n.min(first + BITS);
        numbers.filter(|&number| test(number as u32)).fold(0, |block, number| block | 1_usize << (number - first))
    };
    let blocks: Vec<usize> = (0..n.div_ceil(BITS)).into_par_iter().map(|i| block(i * BITS)).collect();
    FixedBitSet::with_capacity_and_blocks(n, blocks)
}
