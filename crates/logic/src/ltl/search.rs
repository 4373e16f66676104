//! Search for a counterexample to an LTL formula: a path on which it is false.

use fixedbitset::FixedBitSet;

use super::automaton::{Automaton, Mode};
use super::formula::Path;
use crate::bound::Bound;
use crate::fairness::Constraints;
use crate::lasso::round;
use petril_search::{Budget, Follower, Graph, Pairs, Stop, followed};

/// Result of a search for a counterexample.
#[derive(Debug)]
pub enum Search {
    /// A counterexample made of known steps.
    Found(Counterexample),
    /// No path from a known initial state is a counterexample, whatever the missing steps are.
    None,
    /// There may be a counterexample through a state whose steps are not all known.
    Open,
    /// The search was stopped by a limit.
    Stopped(Stop),
    /// The automaton of the formula is too large.
    TooLarge,
}

/// A counterexample: a lasso, or a path that ends in a state without steps, with a shortest stem.
#[derive(Debug)]
pub struct Counterexample {
    /// States of the path.
    pub states: Vec<u32>,
    /// Position to which the last state steps back, for a lasso.
    pub loop_start: Option<usize>,
    /// Values of atoms along the path: position, atom, and value.
    pub atoms: Vec<(usize, Bound, bool)>,
}

/// Searches for a path from an initial state on which a formula is false and which, if infinite, satisfies all fairness
/// constraints. `states_where` gives the states in which an atom holds.
pub fn search(
    graph: &Graph,
    formula: &Path<Bound>,
    constraints: &Constraints,
    states_where: &dyn Fn(&Bound) -> FixedBitSet,
    budget: Budget,
) -> Search {
    let Some(automaton) = Automaton::of(formula, true) else { return Search::TooLarge };
    let open = graph.open();
    let atoms = automaton.atoms.iter().map(states_where).collect();
    let following = Followed { graph, open: &open, automaton: &automaton, atoms };
    let product = match followed(graph, &following, budget) {
        Ok(product) => product,
        Err(stop) => return Search::Stopped(stop),
    };
    // States on fair cycles, or in which paths end: these are entered only in modes that may end.
    let constraints = following.lifted(&product, constraints);
    let mut all = FixedBitSet::with_capacity(product.graph.len());
    all.insert_range(..);
    let mut endings = constraints.rounds(&product.graph, &all);
    let ends = product.pairs.iter().enumerate().filter(|(_, (state, _))| following.ends(*state));
    endings.extend(ends.map(|(pair, _)| pair));
    if let Some(nearest) = endings.ones().next() {
        let found = following.counterexample(&product, &endings, &constraints, nearest as u32);
        return found.map_or(Search::Open, Search::Found);
    }
    match product.pairs.iter().any(|&(state, _)| open.contains(state as usize)) {
        true => Search::Open,
        false => Search::None,
    }
}

/// The automaton on the paths of a graph.
struct Followed<'a> {
    graph: &'a Graph,
    open: &'a FixedBitSet,
    automaton: &'a Automaton,
    /// States in which each atom holds.
    atoms: Vec<FixedBitSet>,
}

impl Follower for Followed<'_> {
    fn enter(&self, from: Option<u32>, state: u32, visit: &mut dyn FnMut(u32)) {
        let ways = from.map_or(0, |mode| self.class(mode));
        let is_last = self.ends(state);
        for &number in &self.automaton.ways[ways as usize] {
            let Mode { literals, may_end, .. } = &self.automaton.modes[number as usize];
            let fits = literals.iter().all(|(&atom, &value)| self.atoms[atom].contains(state as usize) == value);
            if fits && (!is_last || *may_end) {
                visit(number);
            }
        }
    }

    fn class(&self, mode: u32) -> u32 {
        self.automaton.modes[mode as usize].next
    }
}

impl Followed<'_> {
    /// Whether paths end in a state.
    fn ends(&self, state: u32) -> bool {
        self.graph.successors(state).is_empty() && !self.open.contains(state as usize)
    }

    /// Constraints on the paths of the product: those on the graph's paths, and that no until is postponed for ever.
    fn lifted(&self, product: &Pairs, constraints: &Constraints) -> Constraints {
        let pairs_where = |test: &dyn Fn(u32, &Mode) -> bool| {
            let mut set = FixedBitSet::with_capacity(product.pairs.len());
            let pairs = product.pairs.iter().enumerate();
            set.extend(
                pairs
                    .filter(|(_, (state, mode))| test(*state, &self.automaton.modes[*mode as usize]))
                    .map(|(pair, _)| pair),
            );
            set
        };
        let of_graph = |set: &FixedBitSet| pairs_where(&|state, _| set.contains(state as usize));
        let untils = self.automaton.untils.iter().map(|until| pairs_where(&|_, mode| !mode.put_off.contains(until)));
        Constraints {
            weak: constraints.weak.iter().map(of_graph).chain(untils).collect(),
            strong: constraints.strong.iter().map(|(premise, goal)| (of_graph(premise), of_graph(goal))).collect(),
        }
    }

    fn counterexample(
        &self,
        product: &Pairs,
        endings: &FixedBitSet,
        constraints: &Constraints,
        nearest: u32,
    ) -> Option<Counterexample> {
        let mut pairs = product.graph.path_to(nearest);
        let stem = pairs.len() - 1;
        let lasso = round(&product.graph, endings, Some(constraints), nearest)?;
        pairs.extend_from_slice(&lasso.states);
        let pairs: Vec<(u32, u32)> = pairs.into_iter().map(|pair| product.pairs[pair as usize]).collect();
        let of_mode = |(position, &(_, mode)): (usize, &(u32, u32))| {
            let literals = self.automaton.modes[mode as usize].literals.iter();
            literals.map(move |(&atom, &value)| (position, self.automaton.atoms[atom].clone(), value))
        };
        Some(Counterexample {
            states: pairs.iter().map(|&(state, _)| state).collect(),
            loop_start: lasso.loop_start.map(|start| stem + start),
            atoms: pairs.iter().enumerate().flat_map(of_mode).collect(),
        })
    }
}
