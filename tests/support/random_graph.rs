//! Random graphs with marks on their states, and constraints on their paths.

use fixedbitset::FixedBitSet;
use petril::explore::{Budget, Failure, Graph, StateSpace, Step, explore};
use petril::interpret::Fault;
use petril::logic::{Bound, Constraints, Fairness};
use petril::semantics::VarId;
use proptest::prelude::*;

use super::naive_ctl::{Fair, Kripke, rounds};

/// A graph given by lists. State s is of kernel `s / flavours`, and has the successors of its kernel; as a word it is kernel
/// and flavour side by side. Bit v of `marks[s]` is variable v.
#[derive(Debug)]
pub struct Given {
    pub flavours: usize,
    /// By kernel.
    pub successors: Vec<Vec<usize>>,
    pub marks: Vec<u8>,
    pub initial: Vec<usize>,
    /// Whether the search is told that steps depend on the kernel only.
    pub shared: bool,
    /// By kernel, whether the search is not told where the last step leads.
    pub hidden: Vec<bool>,
}

/// The bits of a word that are the kernel.
const KERNEL: [u64; 1] = [0xff];

impl Given {
    fn pack(&self, state: usize) -> u64 {
        (state / self.flavours) as u64 | ((state % self.flavours) as u64) << 8
    }

    fn unpack(&self, word: u64) -> usize {
        (word & KERNEL[0]) as usize * self.flavours + (word >> 8) as usize
    }

    pub fn atom(&self, formula: &Bound, state: usize) -> bool {
        formula.holds_in(&Marks(self.marks[state])).unwrap()
    }

    pub fn explored(&self, states: u64) -> Graph {
        explore(self, Budget { states, ..Budget::default() }, &mut |_| None)
    }

    pub fn name(&self, graph: &Graph, id: u32) -> usize {
        self.unpack(graph.state(id)[0])
    }

    /// The successors of each state.
    pub fn lists(&self) -> Vec<Vec<usize>> {
        let states = 0..self.successors.len() * self.flavours;
        states.map(|s| self.successors[s / self.flavours].clone()).collect()
    }

    pub fn kripke(&self) -> Kripke {
        Kripke::new(self.lists())
    }

    /// The states of a graph that a mask holds.
    pub fn set(&self, graph: &Graph, mask: u64) -> FixedBitSet {
        let mut set = FixedBitSet::with_capacity(graph.len());
        set.extend(graph.ids().filter(|&id| mask >> self.name(graph, id) & 1 == 1).map(|id| id as usize));
        set
    }
}

impl StateSpace for Given {
    fn words(&self) -> usize {
        1
    }

    fn initial(&self, visit: &mut dyn FnMut(Step<'_>)) {
        self.initial.iter().for_each(|&state| visit(Step::To(&[self.pack(state)])));
    }

    fn successors(&self, state: &[u64], visit: &mut dyn FnMut(Step<'_>)) {
        let kernel = (state[0] & KERNEL[0]) as usize;
        let (hidden, told) = match self.successors[kernel].split_last() {
            Some((_, told)) if self.hidden[kernel] => (true, told),
            _ => (false, self.successors[kernel].as_slice()),
        };
        told.iter().for_each(|&next| visit(Step::To(&[self.pack(next)])));
        if hidden {
            visit(Step::Fails(Failure::Scan(Fault::Endless).into()));
        }
    }

    fn relevant(&self) -> Option<&[u64]> {
        self.shared.then_some(&KERNEL)
    }
}

pub struct Marks(pub u8);

impl petril::logic::Valuation for Marks {
    fn value(&self, variable: VarId) -> u64 {
        u64::from(self.0 >> variable.0 & 1)
    }
    fn is_marked(&self, _: petril::net::PlaceId) -> bool {
        unreachable!()
    }
    fn tokens(&self, _: petril::net::PlaceId) -> u64 {
        unreachable!()
    }
    fn is_enabled(&self, _: petril::net::TransitionId) -> bool {
        unreachable!()
    }
    fn is_deadlock(&self) -> bool {
        unreachable!()
    }
}

pub fn given() -> impl Strategy<Value = Given> {
    given_of(8, 4)
}

/// A graph of fewer kernels and flavours than this.
pub fn given_of(kernels: usize, flavours: usize) -> impl Strategy<Value = Given> {
    (1..kernels, 1..flavours, any::<bool>()).prop_flat_map(|(kernels, flavours, shared)| {
        let n = kernels * flavours;
        let successors = proptest::collection::vec(proptest::collection::vec(0..n, 0..4), kernels);
        let marks = proptest::collection::vec(any::<u8>(), n);
        let initial = proptest::collection::vec(0..n, 1..3);
        let hidden = vec![false; kernels];
        (successors, marks, initial).prop_map(move |(successors, marks, initial)| {
            let hidden = hidden.clone();
            Given { flavours, successors, marks, initial, shared, hidden }
        })
    })
}

/// The same, and the search is not told all steps, or so few states as to be found out by this limit.
pub fn given_in_part(kernels: usize, flavours: usize) -> impl Strategy<Value = (Given, u64)> {
    let hidden = proptest::collection::vec(any::<bool>(), kernels);
    (given_of(kernels, flavours), hidden, prop_oneof![Just(u64::MAX), 1..6_u64])
        .prop_map(|(given, hidden, states)| (Given { hidden, ..given }, states))
}

/// Constraints on paths, as masks of states.
#[derive(Clone, Debug)]
pub struct Masks {
    pub weak: Vec<u64>,
    pub strong: Vec<(u64, u64)>,
}

/// Few states in each goal and many in each premise make constraints that matter.
pub fn masks() -> impl Strategy<Value = Masks> {
    let weak = proptest::collection::vec(any::<u64>(), 0..3);
    let strong = proptest::collection::vec((any::<u64>(), any::<u64>(), any::<u64>()), 0..4)
        .prop_map(|masks| masks.into_iter().map(|(p, q, r)| (p, q & r)).collect());
    (weak, strong).prop_map(|(weak, strong)| Masks { weak, strong })
}

impl Masks {
    pub fn kripke(&self, given: &Given) -> Kripke {
        let lists = given.lists();
        Kripke::under(Fair::Rounds(rounds(&lists, &self.weak, &self.strong)), lists)
    }

    pub fn on(&self, given: &Given, graph: &Graph) -> Fairness {
        Fairness::on(graph, self.sets(given, graph))
    }

    pub fn sets(&self, given: &Given, graph: &Graph) -> Constraints {
        let weak = self.weak.iter().map(|&mask| given.set(graph, mask)).collect();
        let strong = self.strong.iter().map(|&(p, q)| (given.set(graph, p), given.set(graph, q))).collect();
        Constraints { weak, strong }
    }

    pub fn are_met_by(&self, round: &[usize]) -> bool {
        let meets = |mask: u64| round.iter().any(|&s| mask >> s & 1 == 1);
        self.weak.iter().all(|&goal| meets(goal)) && self.strong.iter().all(|&(p, q)| !meets(p) || meets(q))
    }
}
