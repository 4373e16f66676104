//! The seam between what has states and what explores them.

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

/// One step.
#[derive(Clone, Copy, Debug)]
pub enum Step<'a> {
    /// A step to this state. The words are only valid during the call.
    To(&'a [u64]),
    /// A step that leads nowhere.
    Fails(DeadEnd),
}

/// A step that leads to no state: something that must not happen does. Each state space has kinds of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeadEnd {
    /// Name of the kind.
    pub kind: &'static str,
    /// Position of the culprit among those of its kind, from 0; 0 where there is only one.
    pub at: usize,
}

/// The steps out of some states, state after state.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Successors {
    /// The words of the states they lead to.
    pub(crate) words: Vec<u64>,
    /// For each state, where the words of its successors end.
    pub(crate) ends: Vec<usize>,
    /// How steps fail, each with the position of the state, once for each.
    pub(crate) failures: Vec<(usize, DeadEnd)>,
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
