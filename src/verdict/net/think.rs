//! Goals in nets too large to explore at once: what walks find, what the state equation excludes, and what searches for one goal
//! at a time, in nets reduced for it, find or exclude.

use super::equation::is_impossible;
use super::hunt::Hunt;
use super::target::Target;
use super::{Means, Reply, Watch};
use crate::explore::engine::{Model, Options, explore_towards};
use crate::explore::{Budget, Goal, Progress, Stop, Walk, without_loops};
use crate::net::{Net, TransitionId};
use crate::structure::state_equation::Problem;

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
    model: Model,
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
    reply: Option<(Reply, Means)>,
    is_noted: bool,
}

/// Called with a reply and the number of its hunt.
type Note<'n> = &'n mut (dyn FnMut(usize, Reply, Means) + 'n);

impl<'n, 'h> Thinker<'n, 'h> {
    /// Takes up the hunts that have a goal.
    pub(super) fn new(net: &'n Net, hunts: &'h [Hunt<'h>]) -> Self {
        let case = |(at, hunt): (usize, &'h Hunt<'h>)| {
            Some(Case { hunt, at, aim: hunt.aim()?, target: None, reply: None, is_noted: false })
        };
        Self {
            net,
            model: Model::from(net),
            cases: hunts.iter().enumerate().filter_map(case).collect(),
            has_begun: false,
        }
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
            let walked = self.walk(None, WALKED, watch);
            self.cases.iter_mut().for_each(|case| case.settle(note));
            walked?;
            let problem = Problem::new(self.net);
            for case in self.cases.iter_mut().filter(|case| case.reply.is_none()) {
                if is_impossible(&problem, self.net, &case.aim, STEPS) {
                    case.reply = case.hunt.absent().map(|reply| (reply, Means::StateEquation));
                }
                case.settle(note);
                look(watch)?;
            }
            for position in 0..self.cases.len() {
                let walked = self.walk(Some(position), WALKED_FOR_ONE, watch);
                self.cases.iter_mut().for_each(|case| case.settle(note));
                walked?;
            }
        }
        let budget = Budget { states: states.min(options.budget.states), ..options.budget };
        let options = Options { budget, keep: true, ..*options };
        for case in self.cases.iter_mut().filter(|case| case.reply.is_none()) {
            case.search(self.net, &self.model, &options, watch)?;
            case.settle(note);
        }
        Ok(())
    }

    /// Walks until so many atoms were looked at: anywhere, or towards one of the goals.
    fn walk(&mut self, towards: Option<usize>, atoms: usize, watch: Watch<'_>) -> Result<(), String> {
        if towards.is_some_and(|position| self.cases[position].reply.is_some()) {
            return Ok(());
        }
        let seed = towards.map_or(1, |position| position as u64 + 2);
        let Some(mut walk) = Walk::new(&self.model, seed) else { return Ok(()) };
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
            let mut open = 0;
            for case in self.cases.iter_mut().filter(|case| case.reply.is_none()) {
                looked += 1 + size(&case.aim);
                open += 1;
                if case.aim.holds(&walk) {
                    case.found(self.net, &without_loops(&self.model, walk.firings()), Means::Walk);
                }
            }
            if open == 0 || towards.is_some_and(|position| self.cases[position].reply.is_some()) {
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
    fn found(&mut self, net: &'n Net, firings: &[u32], by: Means) {
        let run = firings.iter().map(|&transition| TransitionId::at(transition as usize)).collect();
        self.reply = self.hunt.reached(net, run, by).map(|reply| (reply, by));
        if let (None, Some(aim)) = (&self.reply, self.hunt.aim()) {
            self.aim = aim;
        }
    }

    /// Notes the reply, if there is one.
    fn settle(&mut self, note: Note<'_>) {
        if let Some((reply, by)) = self.reply.as_ref().filter(|_| !self.is_noted) {
            note(self.at, reply.clone(), *by);
            self.is_noted = true;
        }
    }

    /// Searches the net reduced for the goal.
    fn search(&mut self, net: &'n Net, model: &Model, options: &Options, watch: Watch<'_>) -> Result<(), String> {
        while self.reply.is_none() {
            let target = self.target.get_or_insert_with(|| Target::of(net, &self.aim));
            let (goal, by) = (target.goal(&self.aim), target.means());
            let mut reason = None;
            let mut watch = |progress: &Progress| {
                reason = watch(progress);
                reason.clone()
            };
            let exploration = explore_towards(&target.model, options, &mut watch, &goal);
            if let Some(found) = &exploration.found {
                let firings = exploration.firings(found).ok_or("the way to a marking is lost, which is an error")?;
                match target.lifted(&firings) {
                    Some(firings) => self.found(net, &without_loops(model, &firings), by),
                    None => self.target = Some(Target::unreduced(net)),
                }
            } else if exploration.stop == Stop::Complete {
                self.reply = self.hunt.absent().map(|reply| (reply, by));
            } else {
                return reason.map_or(Ok(()), Err);
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

/// Looks at the clock.
fn look(watch: Watch<'_>) -> Result<(), String> {
    watch(&Progress::default()).map_or(Ok(()), Err)
}
