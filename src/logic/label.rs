//! Which states satisfy which node, by the classical fixpoints on sets of states (Clarke, Emerson and Sistla 1986), each in
//! time linear in the graph, where a row that many states share is gone through once.
//!
//! A path ends only in a state without steps; there X g is true under A and false under E, and W needs nothing more. Where a
//! graph is not complete, a state is in a set only if the node holds whatever the missing steps are. So a formula holds if
//! the initial states are in its set, is violated if one of them is in the set of its negation, and is undecided otherwise.

use fixedbitset::FixedBitSet;
use rayon::prelude::*;

use super::bound::Bound;
use super::dag::{Dag, Node, NodeId};
use super::formula::Quantifier;
use crate::explore::{Graph, components};

/// The states that satisfy each node of a [`Dag`].
pub struct Labels {
    sets: Vec<FixedBitSet>,
}

impl Labels {
    /// The states that satisfy a node.
    #[must_use]
    pub fn of(&self, node: NodeId) -> &FixedBitSet {
        &self.sets[node.index()]
    }
}

/// Labels every node. `holds` evaluates a formula about one state in a state. With `fair`, only paths that visit this set of
/// states again and again count; every state must have such a path.
pub fn label(
    graph: &Graph,
    dag: &Dag,
    holds: &(dyn Fn(&Bound, u32) -> bool + Sync),
    fair: Option<&FixedBitSet>,
) -> Labels {
    label_from(graph, dag, &mut |_, formula| set_where(graph.len(), |state| holds(formula, state)), fair)
}

/// As [`label`], where `holding` gives the states in which a formula about one state holds, that of a node.
pub fn label_from(
    graph: &Graph,
    dag: &Dag,
    holding: &mut dyn FnMut(NodeId, &Bound) -> FixedBitSet,
    fair: Option<&FixedBitSet>,
) -> Labels {
    let open = graph.open();
    let labeller = Labeller { graph, open: &open, fair };
    let mut sets: Vec<FixedBitSet> = Vec::with_capacity(dag.nodes().len());
    for (position, node) in dag.nodes().iter().enumerate() {
        let set = |id: &NodeId| &sets[id.index()];
        let labelled = match node {
            Node::State { formula, negated } => {
                let mut states = holding(NodeId::at(position), formula);
                if *negated {
                    states.toggle_range(..);
                }
                states
            }
            Node::And(f, g) => set(f) & set(g),
            Node::Or(f, g) => set(f) | set(g),
            Node::Next(Quantifier::Some, f) => labeller.exists_next(set(f)),
            Node::Next(Quantifier::All, f) => labeller.all_next(set(f)),
            Node::Until(Quantifier::Some, f, g) => labeller.exists_until(set(f), set(g)),
            Node::Until(Quantifier::All, f, g) => labeller.all_until(set(f), set(g)),
            Node::WeakUntil(Quantifier::Some, f, g) => labeller.exists_weak_until(set(f), set(g)),
            Node::WeakUntil(Quantifier::All, f, g) => labeller.all_weak_until(set(f), set(g)),
        };
        sets.push(labelled);
    }
    Labels { sets }
}

/// The states from which a path stays in `within` and goes round for ever: those on a cycle inside it (through a fair state,
/// if fairness is asked for), and those where paths end.
pub(super) fn endings(graph: &Graph, within: &FixedBitSet, fair: Option<&FixedBitSet>) -> FixedBitSet {
    let components = components(graph, within);
    let mut fair_components = components.cyclic.clone();
    if let Some(fair) = fair {
        let mut visited = FixedBitSet::with_capacity(components.count);
        within.intersection(fair).for_each(|state| visited.insert(components.of[state] as usize));
        fair_components.intersect_with(&visited);
    }
    let open = graph.open();
    let mut endings = FixedBitSet::with_capacity(graph.len());
    for state in within.ones() {
        let cyclic = fair_components.contains(components.of[state] as usize);
        if cyclic || (graph.successors(state as u32).is_empty() && !open.contains(state)) {
            endings.insert(state);
        }
    }
    endings
}

struct Labeller<'a> {
    graph: &'a Graph,
    open: &'a FixedBitSet,
    fair: Option<&'a FixedBitSet>,
}

impl Labeller<'_> {
    fn states_where(&self, test: impl Fn(u32) -> bool + Sync) -> FixedBitSet {
        set_where(self.graph.len(), test)
    }

    fn complement(&self, set: &FixedBitSet) -> FixedBitSet {
        let mut complement = set.clone();
        complement.toggle_range(..);
        complement
    }

    /// The rows that satisfy a test.
    fn rows_where(&self, test: impl Fn(&[u32]) -> bool + Sync) -> FixedBitSet {
        set_where(self.graph.rows(), |row| test(self.graph.row(row)))
    }

    fn exists_next(&self, f: &FixedBitSet) -> FixedBitSet {
        let rows = self.rows_where(|row| row.iter().any(|&next| f.contains(next as usize)));
        self.states_where(|state| self.graph.row_of(state).is_some_and(|row| rows.contains(row as usize)))
    }

    fn all_next(&self, f: &FixedBitSet) -> FixedBitSet {
        let rows = self.rows_where(|row| row.iter().all(|&next| f.contains(next as usize)));
        let all = |state| self.graph.row_of(state).is_some_and(|row| rows.contains(row as usize));
        self.states_where(|state| !self.open.contains(state as usize) && all(state))
    }

    fn exists_until(&self, f: &FixedBitSet, g: &FixedBitSet) -> FixedBitSet {
        let mut set = g.clone();
        let mut reaching = FixedBitSet::with_capacity(self.graph.rows());
        let mut work: Vec<u32> = g.ones().map(|state| state as u32).collect();
        while let Some(state) = work.pop() {
            for &row in self.graph.rows_to(state) {
                if reaching.put(row as usize) {
                    continue;
                }
                let members = self.graph.members(row).iter().copied();
                work.extend(members.filter(|&before| f.contains(before as usize) && !set.put(before as usize)));
            }
        }
        set
    }

    fn all_weak_until(&self, f: &FixedBitSet, g: &FixedBitSet) -> FixedBitSet {
        // A[f W g] = ¬E[¬g U ¬(f ∨ g)], an unknown step being as bad as one to a state without f and g.
        let not_g = self.complement(g);
        let mut bad = self.complement(&(f | g));
        bad.union_with(&(self.open & &not_g));
        self.complement(&self.exists_until(&not_g, &bad))
    }

    fn all_until(&self, f: &FixedBitSet, g: &FixedBitSet) -> FixedBitSet {
        // Under fairness, A[f U g] = ¬E[¬g W ¬f ∧ ¬g]; the complement needs all steps. Without them, the set for all paths
        // serves: what holds on all paths holds on the fair ones.
        if self.fair.is_some() && self.graph.is_complete() {
            let not_g = self.complement(g);
            let neither = self.complement(&(f | g));
            return self.complement(&self.exists_weak_until(&not_g, &neither));
        }
        let mut set = g.clone();
        let rows = 0..self.graph.rows() as u32;
        let mut missing: Vec<usize> = rows.map(|row| self.graph.row(row).len()).collect();
        let mut work: Vec<u32> = g.ones().map(|state| state as u32).collect();
        while let Some(state) = work.pop() {
            for &row in self.graph.rows_to(state) {
                missing[row as usize] -= 1;
                if missing[row as usize] > 0 {
                    continue;
                }
                for &before in self.graph.members(row) {
                    let b = before as usize;
                    if f.contains(b) && !self.open.contains(b) && !set.put(b) {
                        work.push(before);
                    }
                }
            }
        }
        set
    }

    fn exists_weak_until(&self, f: &FixedBitSet, g: &FixedBitSet) -> FixedBitSet {
        // E[f W g] = E[f U g ∨ "f on a path that never leaves f"].
        let mut goal = endings(self.graph, f, self.fair);
        goal.union_with(g);
        self.exists_until(f, &goal)
    }
}

/// The numbers below `n` that satisfy a test, computed on all processors.
fn set_where(n: usize, test: impl Fn(u32) -> bool + Sync) -> FixedBitSet {
    const BITS: usize = usize::BITS as usize;
    let block = |first: usize| {
        let numbers = first..n.min(first + BITS);
        numbers.filter(|&number| test(number as u32)).fold(0, |block, number| block | 1_usize << (number - first))
    };
    let blocks: Vec<usize> = (0..n.div_ceil(BITS)).into_par_iter().map(|i| block(i * BITS)).collect();
    FixedBitSet::with_capacity_and_blocks(n, blocks)
}
