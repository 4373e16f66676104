//! Portfolio for goals in nets too large to explore at once: random walks, the state equation, and a stubborn-set
//! search for one goal at a time in the net reduced for it.

use std::sync::atomic::AtomicBool;

use super::equation::is_impossible;
use super::hunt::Hunt;
use super::target::Target;
use super::{Means, Reply, Watch};
use crate::engine::{Model, Options, explore_towards};
use crate::net::{Net, TransitionId};
use crate::structure::state_equation::Problem;
use crate::{Goal, Walk, without_loops};
use petril_search::{Budget, Progress, Stop, watched};

/// Atoms evaluated by random walks: for all goals together, and towards one.
const WALKED: usize = 6_000_000;
const WALKED_FOR_ONE: usize = 1_500_000;

/// Firings of the first walk. Each walk is longer than the one before, up to the limit `LONG`.
const SHORT: usize = 200;
const LONG: usize = 1 << 20;

/// Walk steps between two calls of `watch`.
const PAUSE: usize = 4096;

/// Elementary steps of the linear programs for one goal.
const STEPS: u64 = 20_000_000;

/// Goals that the exploration has left open, with the state of the portfolio.
pub(super) struct Thinker<'n, 'h> {
    net: &'n Net,
    model: &'n Model,
    cases: Vec<Case<'n, 'h>>,
    has_begun: bool,
}

/// Goal with its search state.
struct Case<'n, 'h> {
    hunt: &'h Hunt<'h>,
    /// Number among the properties.
    at: usize,
    aim: Goal,
    target: Option<Target<'n>>,
    is_open: bool,
}

/// Callback for an answer and the number of its property.
type Note<'n> = &'n mut (dyn FnMut(usize, Reply, Means) + 'n);

impl<'n, 'h> Thinker<'n, 'h> {
    /// Takes the properties that have a goal.
    pub(super) fn new(net: &'n Net, model: &'n Model, hunts: &'h [Hunt<'h>]) -> Self {
        let case =
            |(at, hunt): (usize, &'h Hunt<'h>)| Some(Case { hunt, at, aim: hunt.aim()?, target: None, is_open: true });
        Self { net, model, cases: hunts.iter().enumerate().filter_map(case).collect(), has_begun: false }
    }

    /// Works one round on the open properties, with up to `states` states for each goal; ends when `watch` gives a reason
    /// to stop, which is returned.
    pub(super) fn round(
        &mut self,
        open: &[usize],
        states: u64,
        options: &Options,
        watch: Watch<'_>,
        note: Note<'_>,
    ) -> Option<String> {
        self.cases.retain(|case| open.binary_search(&case.at).is_ok());
        for case in &mut self.cases {
            // The search may have raised a maximum.
            if let Some(aim) = case.hunt.aim() {
                case.aim = aim;
            }
        }
        self.work(states, options, watch, note).err()
    }

    fn work(&mut self, states: u64, options: &Options, watch: Watch<'_>, note: Note<'_>) -> Result<(), String> {
        if !std::mem::replace(&mut self.has_begun, true) {
            self.walk(None, WALKED, watch, note)?;
            let problem = Problem::new(self.net);
            for case in self.cases.iter_mut().filter(|case| case.is_open) {
                let (net, aim) = (self.net, &case.aim);
                if patiently(watch, |stopping| is_impossible(&problem, net, aim, STEPS, stopping))? {
                    case.settle(case.hunt.absent(), Means::StateEquation, note);
                }
            }
            for position in 0..self.cases.len() {
                self.walk(Some(position), WALKED_FOR_ONE, watch, note)?;
            }
        }
        let budget = Budget { states: states.min(options.budget.states), ..options.budget };
        let options = Options { budget, keep: true, ..*options };
        for case in &mut self.cases {
            case.search(self.net, self.model, &options, watch, note)?;
        }
        Ok(())
    }

    /// Random walks until this many atoms were evaluated: undirected, or towards one of the goals.
    fn walk(&mut self, towards: Option<usize>, atoms: usize, watch: Watch<'_>, note: Note<'_>) -> Result<(), String> {
        let is_over = |cases: &[Case<'_, '_>]| match towards {
            Some(position) => !cases[position].is_open,
            None => cases.iter().all(|case| !case.is_open),
        };
        if is_over(&self.cases) {
            return Ok(());
        }
        let seed = towards.map_or(1, |position| position as u64 + 2);
        let Some(mut walk) = Walk::new(self.model, seed) else { return Ok(()) };
        // Raising a goal does not change its size.
        let sizes: Vec<usize> = self.cases.iter().map(|case| size(&case.aim)).collect();
        let (mut looked, mut steps, mut length) = (0, 0, SHORT);
        while looked < atoms {
            let goes_on = walk.firings().len() < length
                && match towards {
                    Some(position) => walk.step_towards(&self.cases[position].aim),
                    None => walk.step(),
                };
            if !goes_on {
                length = (length + length / 2).min(LONG);
                walk.restart();
                looked += self.model.initial.len();
            }
            for (case, size) in self.cases.iter_mut().zip(&sizes).filter(|(case, _)| case.is_open) {
                looked += 1 + size;
                if case.aim.holds(&walk) {
                    case.found(self.net, &without_loops(self.model, walk.firings()), Means::Walk, note);
                }
            }
            if is_over(&self.cases) {
                return Ok(());
            }
            looked += 1;
            steps += 1;
            if steps % PAUSE == 0 {
                look(watch)?;
            }
        }
        Ok(())
    }
}

impl<'n> Case<'n, '_> {
    /// Records a run to the goal. The goal of a maximum is raised instead of settled.
    fn found(&mut self, net: &Net, firings: &[u32], by: Means, note: Note<'_>) {
        let run = firings.iter().map(|&transition| TransitionId::at(transition as usize)).collect();
        self.settle(self.hunt.reached(net, run, by), by, note);
        if let Some(aim) = self.hunt.aim().filter(|_| self.is_open) {
            self.aim = aim;
        }
    }

    /// Passes on an answer, if there is one.
    fn settle(&mut self, reply: Option<Reply>, by: Means, note: Note<'_>) {
        if let Some(reply) = reply {
            note(self.at, reply, by);
            self.is_open = false;
        }
    }

    /// Searches the reduced net for the goal.
    fn search(
        &mut self,
        net: &'n Net,
        model: &Model,
        options: &Options,
        watch: Watch<'_>,
        note: Note<'_>,
    ) -> Result<(), String> {
        while self.is_open {
            if self.target.is_none() {
                self.target = Some(patiently(watch, |stopping| Target::of(net, &self.aim, stopping))?);
            }
            let Some(target) = &self.target else { return Ok(()) };
            let by = target.means();
            let exploration = explore_towards(target.model(model), options, watch, &target.goal(&self.aim));
            if let Some(found) = &exploration.found {
                let firings = exploration.firings(found).ok_or("the way to a marking is lost, which is an error")?;
                match target.lifted(&firings) {
                    Some(firings) => self.found(net, &without_loops(model, &firings), by, note),
                    None => self.target = Some(Target::unreduced(net)),
                }
                continue;
            }
            match exploration.stop {
                Stop::Complete => self.settle(self.hunt.absent(), by, note),
                Stop::Watcher(reason) => return Err(reason),
                _ => return Ok(()),
            }
        }
        Ok(())
    }
}

/// Number of atoms of a goal.
fn size(goal: &Goal) -> usize {
    match goal {
        Goal::All(parts) | Goal::Any(parts) => parts.iter().map(size).sum(),
        Goal::AtLeast { terms, .. } => terms.len(),
        _ => 1,
    }
}

/// Does some work, unless `watch` gives a reason to stop, which is returned.
fn patiently<T: Send>(watch: Watch<'_>, work: impl FnOnce(&AtomicBool) -> T + Send) -> Result<T, String> {
    match watched(watch, &Progress::default(), work) {
        (_, Some(reason)) => Err(reason),
        (Some(done), None) => Ok(done),
        (None, None) => Err("the work was not done, which is an error".to_owned()),
    }
}

/// Asks `watch` for a reason to stop.
fn look(watch: Watch<'_>) -> Result<(), String> {
    watch(&Progress::default()).map_or(Ok(()), Err)
}
