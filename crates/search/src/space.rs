//! Interface between systems with states and the search.

/// A transition system. A state is a vector of `u64` words, of the same length for all states.
///
/// Successors depend only on the state, and always come in the same order. Implementations are shared between threads.
pub trait StateSpace: Sync {
    /// Length of a state in words.
    fn words(&self) -> usize;

    /// Calls `visit` with each step to an initial state.
    fn initial(&self, visit: &mut dyn FnMut(Step<'_>));

    /// Calls `visit` with each step out of a state.
    fn successors(&self, state: &[u64], visit: &mut dyn FnMut(Step<'_>));

    /// Computes the steps out of consecutive states. Spaces that compute many states at once override this.
    fn expand(&self, states: &[u64], into: &mut Successors) {
        for state in states.chunks_exact(self.words()) {
            self.successors(state, &mut |step| into.add(step));
            into.finish();
        }
    }

    /// Mask of the bits of a state on which its steps depend: states that agree on these have the same steps. `None`
    /// for all bits.
    fn relevant(&self) -> Option<&[u64]> {
        None
    }

    /// Approximate number of steps out of a state; `None` stands for the initial states. Spaces with millions of steps
    /// override this, so that the search can give up before it begins.
    fn fan_out(&self, state: Option<&[u64]>) -> u64 {
        let _ = state;
        8
    }

    /// Reason why the space is too large for any search, and what to do about it; or why its steps cannot be trusted.
    fn refusal(&self) -> Option<String> {
        None
    }
}

/// A step of a state space.
#[derive(Clone, Copy, Debug)]
pub enum Step<'a> {
    /// Step to this state. The words are only valid during the call.
    To(&'a [u64]),
    /// A step that leads nowhere.
    Fails(DeadEnd),
}

/// Reason why a step has no successor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeadEnd {
    /// Name of the kind.
    pub kind: &'static str,
    /// Position of the culprit among those of its kind, from 0; 0 where there is only one.
    pub at: usize,
}

/// Steps out of consecutive states.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Successors {
    /// Words of the successors.
    pub(crate) words: Vec<u64>,
    /// For each state, the end offset of its successors' words.
    pub(crate) ends: Vec<usize>,
    /// How steps fail, each with the position of the state, once for each.
    pub(crate) failures: Vec<(usize, DeadEnd)>,
}

impl Successors {
    /// Adds a step out of the current state.
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

    /// Ends the steps out of the current state.
    pub fn finish(&mut self) {
        self.ends.push(self.words.len());
    }
}
