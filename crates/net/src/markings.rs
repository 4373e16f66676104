//! The transition view: the reachable markings of a safe net, explored by the [engine](super::engine). Every firing is
//! a step.

use crate::engine::{self, Exploration, Steps, explore_safely};
use crate::net::{Net, PlaceId, TransitionId};
use petril_base::VarId;
use petril_logic::Valuation;
use petril_search::{Budget, DeadEnd, Graph, Parts, Progress, Step, Stop, watched};

/// Reachable markings of a net, with their graph.
pub struct Markings<'n> {
    net: &'n Net,
    exploration: Exploration,
    graph: Graph,
}

/// Memory reserved per state during the search, in bytes: two words, a row, and five steps.
const ROW: u64 = 2 * 8 + 12 + 5 * 4;

impl<'n> Markings<'n> {
    /// Explores a net until all markings are found, the budget is used up, or `watch` returns a reason to stop. `watch`
    /// is called every few hundred markings. A firing that puts a second token on a place fails: it has no successor.
    #[must_use]
    pub fn explored(net: &'n Net, budget: Budget, watch: &mut dyn FnMut(&Progress) -> Option<String>) -> Self {
        // Numbers of states have 32 bits; half of the range leaves room for the states in progress.
        let budget = Budget { states: budget.states.min(u64::from(u32::MAX) >> 1), ..budget };
        let options = engine::Options { budget, threads: 1, keep: true };
        let mut full = false;
        let mut exploration = explore_safely(net, &options, &mut |progress| {
            let bytes = progress.bytes + progress.states * ROW;
            full = bytes > budget.bytes;
            watch(&Progress { bytes, ..*progress }).or_else(|| full.then(String::new))
        });
        let taken = exploration.figures.bytes + exploration.figures.states * (ROW - 5 * 4);
        let most = (budget.bytes.saturating_sub(taken) / 4) as usize;
        let progress = exploration.progress();
        let (steps, stopped) = watched(watch, &progress, |stopping| exploration.steps_within(most, stopping));
        let (starts, targets) = steps.flatten().map_or_else(|| (vec![0], Vec::new()), Steps::into_parts);
        let states = exploration.figures.states as usize;
        let stop = match exploration.stop {
            Stop::Watcher(_) if full => Stop::Bytes(budget.bytes),
            Stop::Complete if starts.len() <= states => stopped.map_or(Stop::Bytes(budget.bytes), Stop::Watcher),
            ref stop => stop.clone(),
        };
        let (words, levels, arena) = (exploration.words(), exploration.levels(), exploration.take_states());
        let graph = Graph::of_parts(Parts { words, states, arena, starts, targets, levels, stop });
        let mut markings = Self { net, exploration, graph };
        let failures = markings.failures();
        markings.graph.add_failures(failures);
        markings
    }

    /// The net explored.
    #[must_use]
    pub fn net(&self) -> &'n Net {
        self.net
    }

    /// The reachability graph.
    #[must_use]
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// Whether a place is marked in a state.
    #[must_use]
    pub fn is_marked(&self, state: &[u64], place: PlaceId) -> bool {
        self.exploration.tokens(state, place.index()) > 0
    }

    /// Whether a transition is enabled in a state.
    #[must_use]
    pub fn is_enabled(&self, state: &[u64], transition: TransitionId) -> bool {
        self.net.arcs(transition).preset().all(|place| self.is_marked(state, place))
    }

    /// Whether no transition is enabled in a state.
    #[must_use]
    pub fn is_deadlock(&self, state: &[u64]) -> bool {
        self.exploration.show(state, |view| view.enabled().next().is_none()) && self.failing(state).next().is_none()
    }

    /// Calls `visit` with each enabled transition and its step.
    pub fn firings(&self, state: &[u64], visit: &mut dyn FnMut(TransitionId, Step<'_>)) {
        let mut next = vec![0; state.len()];
        self.exploration.show(state, |view| {
            for transition in view.enabled() {
                next.copy_from_slice(state);
                if self.exploration.fire(transition, &mut next) {
                    visit(TransitionId::at(transition), Step::To(&next));
                }
            }
        });
        self.failing(state).for_each(|(id, place)| visit(id, Step::Fails(second_token(place))));
    }

    /// Transitions whose firing would put a second token on a place, each with the place.
    fn failing(&self, state: &[u64]) -> impl Iterator<Item = (TransitionId, PlaceId)> {
        let transitions = if self.is_guarded() { self.net.transitions().len() } else { 0 };
        (0..transitions).map(TransitionId::at).filter_map(move |id| {
            let arcs = self.net.arcs(id);
            let second = |place: &PlaceId| self.is_marked(state, *place) && !arcs.consume.contains(place);
            let place = arcs.produce.iter().copied().find(second)?;
            self.is_enabled(state, id).then_some((id, place))
        })
    }

    /// Whether there are complementary places, so that firings can fail.
    fn is_guarded(&self) -> bool {
        self.exploration.places() > self.net.places().len()
    }

    /// The firings that would put a second token, once for each state and place.
    fn failures(&self) -> Vec<(u32, DeadEnd)> {
        let mut failures: Vec<(u32, DeadEnd)> = Vec::new();
        if self.is_guarded() {
            for id in 0..self.graph.expanded() as u32 {
                let first = failures.len();
                for (_, place) in self.failing(self.graph.state(id)) {
                    let failure = (id, second_token(place));
                    if !failures[first..].contains(&failure) {
                        failures.push(failure);
                    }
                }
            }
        }
        failures
    }
}

/// The kind of [`DeadEnd`] of a firing that would put a second token on a place, which it names by position.
pub const SECOND_TOKEN: &str = "second token";

fn second_token(place: PlaceId) -> DeadEnd {
    DeadEnd { kind: SECOND_TOKEN, at: place.index() }
}

/// A packed marking. Formulas bound for the transition view speak of places and transitions only.
pub struct MarkingValuation<'a>(pub &'a Markings<'a>, pub &'a [u64]);

impl Valuation for MarkingValuation<'_> {
    fn value(&self, _: VarId) -> u64 {
        0
    }

    fn is_marked(&self, place: PlaceId) -> bool {
        self.0.is_marked(self.1, place)
    }

    fn is_enabled(&self, transition: TransitionId) -> bool {
        self.0.is_enabled(self.1, transition)
    }

    fn is_deadlock(&self) -> bool {
        self.0.is_deadlock(self.1)
    }
}
