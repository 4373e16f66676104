//! Goals in nets too large to explore at once: what walks find, what the state equation excludes, and what searches for one goal
//! at a time, in nets reduced for it, find or exclude.

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

/// Atoms that walks look at, those for all goals together and those for one.
const WALKED: usize = 6_000_000;
const WALKED_FOR_ONE: usize = 1_500_000;

/// Firings of the first walk. Each one is longer than the one before, up to a limit.
const SHORT: usize = 200;
const LONG: usize = 1 << 20;

/// Steps between two looks at the clock.
const PAUSE: usize = 4096;

/// Elementary steps of the linear programs for one goal.
const STEPS: u64 = 20_000_000;

/// Goals that the first look at the states has left open.
pub(super) struct Thinker<'n, 'h> {
    net: &'n Net,
    model: &'n Model,
    cases: Vec<Case<'n, 'h>>,
    has_begun: bool,
}

/// A goal that is open until it has a reply.
struct Case<'n, 'h> {
    hunt: &'h Hunt<'h>,
    /// Where it stands among the hunts.
    at: usize,
    aim: Goal,
    target: Option<Target<'n>>,
    is_open: bool,
}

/// Called with a reply and the number of its hunt.
type Note<'n> = &'n mut (dyn FnMut(usize, Reply, Means) + 'n);

impl<'n, 'h> Thinker<'n, 'h> {
    /// Takes up the hunts that have a goal.
    pub(super) fn new(net: &'n Net, model: &'n Model, hunts: &'h [Hunt<'h>]) -> Self {
        let case =
            |(at, hunt): (usize, &'h Hunt<'h>)| Some(Case { hunt, at, aim: hunt.aim()?, target: None, is_open: true });
        Self { net, model, cases: hunts.iter().enumerate().filter_map(case).collect(), has_begun: false }
    }

    /// Looks for replies to those of the hunts that are open, with up to so many states for each goal, until `watch` gives a
    /// reason to stop, which is returned.
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
            // The search may have raised it.
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

    /// Walks until so many atoms were looked at: anywhere, or towards one of the goals.
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
        // Raising a goal leaves it as long as it was.
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
    /// The net reaches the goal by these firings. A goal that can be raised is raised.
    fn found(&mut self, net: &Net, firings: &[u32], by: Means, note: Note<'_>) {
        let run = firings.iter().map(|&transition| TransitionId::at(transition as usize)).collect();
        self.settle(self.hunt.reached(net, run, by), by, note);
        if let Some(aim) = self.hunt.aim().filter(|_| self.is_open) {
            self.aim = aim;
        }
    }

    /// Notes a reply, if there is one.
    fn settle(&mut self, reply: Option<Reply>, by: Means, note: Note<'_>) {
        if let Some(reply) = reply {
            note(self.at, reply, by);
            self.is_open = false;
        }
    }

    /// Searches the net reduced for the goal.
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

/// How many atoms a goal has.
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

/// Looks at the clock.
fn look(watch: Watch<'_>) -> Result<(), String> {
    watch(&Progress::default()).map_or(Ok(()), Err)
}
