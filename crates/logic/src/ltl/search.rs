//! A path on which a formula is false, or that there is none.

use fixedbitset::FixedBitSet;

use super::automaton::{Automaton, Mode};
use super::formula::Path;
use crate::bound::Bound;
use crate::fairness::Constraints;
use crate::lasso::round;
use petril_search::{Budget, Follower, Graph, Pairs, Stop, followed};

/// What a search for a path on which a formula is false came to.
#[derive(Debug)]
pub enum Search {
    /// There is one, made of known steps.
    Found(Counterexample),
    /// There is none, whatever the missing steps are, as far as paths from known initial states go.
    None,
    /// There may be one behind a state whose steps are not all known.
    Open,
    /// Only so much of the paths can be gone through.
    Stopped(Stop),
    /// The formula is too large.
    TooLarge,
}

/// A path without end, or one that ends where no step is left: a shortest way to where it goes round, or ends.
#[derive(Debug)]
pub struct Counterexample {
    /// The states of the path.
    pub states: Vec<u32>,
    /// For a lasso, the position to which the last state steps back.
    pub loop_start: Option<usize>,
    /// What atoms must be on the path: for each of its positions, which atom is true or false there.
    pub atoms: Vec<(usize, Bound, bool)>,
}

/// Looks for a path from an initial state that meets all constraints, if it has no end, and on which a formula is false.
/// `states_where` gives the states in which an atom holds.
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
    // Where paths can go round for ever, or end: only modes that may end come to where they do.
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

/// A graph and the automaton that follows its paths.
struct Followed<'a> {
    graph: &'a Graph,
    open: &'a FixedBitSet,
    automaton: &'a Automaton,
    /// The states in which each atom holds.
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

    /// Constraints on the paths of the product: those on the graph's paths, and that no until is put off for ever.
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
