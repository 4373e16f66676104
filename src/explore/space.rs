//! The seam between what has states and what explores them.

use crate::net::PlaceId;
use petril_lang::flat::Hazard;
use petril_lang::interpret::Fault;
use petril_lang::semantics::VarId;

/// A system as states and steps. A state is a vector of `u64` words, of the same length for all states.
///
/// Successors depend on nothing but the state, and come in the same order whenever asked for. Implementations are shared
/// between threads.
pub trait StateSpace: Sync {
    /// Length of a state in words.
    fn words(&self) -> usize;

    /// Calls `visit` for each initial state.
    fn initial(&self, visit: &mut dyn FnMut(Step<'_>));

    /// Calls `visit` for each step out of a state.
    fn successors(&self, state: &[u64], visit: &mut dyn FnMut(Step<'_>));

    /// The steps out of some states, given one after another. What is computed for many states at once is computed here.
    fn expand(&self, states: &[u64], into: &mut Successors) {
        for state in states.chunks_exact(self.words()) {
            self.successors(state, &mut |step| into.add(step));
            into.finish();
        }
    }

    /// The bits of a state that its steps depend on: states that agree in these have the same steps. `None` if all do.
    fn relevant(&self) -> Option<&[u64]> {
        None
    }

    /// About how many steps leave a state. A space whose steps are counted in millions says so here, so that the search
    /// can give up before it begins; the initial states are meant by `None`.
    fn fan_out(&self, state: Option<&[u64]>) -> u64 {
        let _ = state;
        8
    }

    /// Why the space is too large for any search, and what its owner can do about it; or why its steps cannot be trusted.
    fn refusal(&self) -> Option<String> {
        None
    }
}

/// Says which scans can begin: what inputs do not do is not explored.
pub trait Admission: Sync {
    /// Whether a scan may begin with these inputs. `before` gives the values of variables at the end of the scan before, `now` those
    /// of the inputs that are read.
    fn admits(&self, before: &dyn Fn(VarId) -> u64, now: &dyn Fn(VarId) -> u64) -> bool;
    /// The variables whose values before make a difference.
    fn recalls(&self) -> Vec<VarId>;
}

/// One step.
#[derive(Clone, Copy, Debug)]
pub enum Step<'a> {
    /// It leads to this state. The words are only valid during the call.
    To(&'a [u64]),
    /// It leads nowhere: something that must not happen does.
    Fails(Failure),
}

/// Why a step has no state behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure {
    /// A scan does not end.
    Scan(Fault),
    /// A scan meets a hazard that is an error, in this line (from 0).
    Hazard(usize, Hazard),
    /// A firing puts a second token on a place.
    NotSafe(PlaceId),
}

/// The steps out of some states, state after state.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Successors {
    /// The words of the states they lead to.
    pub(super) words: Vec<u64>,
    /// For each state, where the words of its successors end.
    pub(super) ends: Vec<usize>,
    /// How steps fail, each with the position of the state, once for each.
    pub(super) failures: Vec<(usize, Failure)>,
}

impl Successors {
    /// A step out of the state at hand.
    pub fn add(&mut self, step: Step<'_>) {
        match step {
            Step::To(state) => self.words.extend_from_slice(state),
            Step::Fails(failure) => {
                let failure = (self.ends.len(), failure);
                let mut own = self.failures.iter().rev().take_while(|(state, _)| *state == failure.0);
                if !own.any(|&known| known == failure) {
                    self.failures.push(failure);
                }
            }
        }
    }

    /// All steps out of the state at hand were added.
    pub fn finish(&mut self) {
        self.ends.push(self.words.len());
    }
}
