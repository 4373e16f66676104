//! Interactive session: a run that is stepped and steered.

use super::breakpoint::Breakpoint;
use super::chance::Chance;
use super::plan::{self, Plan};
use super::stopped::Stopped;
use super::watch::Watch;
use super::within::Within;
use crate::scans::{Failure, ScanState};
use crate::translate::{PlaceRole, System};
use crate::witness::{PlantMove, Replay, Scan};
use petril_lang::flat::Tolerated;
use petril_lang::semantics::{Role, Type, VarId};
use petril_net::net::TransitionId;

/// A run that can be stepped forward and back, by scans, lines and transitions, with inputs chosen before each scan.
///
/// The plan of each scan is recorded. Stepping back keeps the plans, so stepping forward repeats them; a change
/// discards the plans after it.
#[derive(Clone, Debug)]
pub struct Session<'s> {
    system: &'s System,
    tolerated: Tolerated,
    power_on: ScanState,
    /// Scans that have ended.
    scans: Vec<Scan>,
    /// Plans of the scans that have ended and of the next ones.
    plans: Vec<Plan>,
    /// First scan whose plan differs from the original one.
    altered: usize,
    /// Scan under way.
    within: Option<Within<'s>>,
    /// Failure of the last scan.
    failure: Option<Failure>,
}

impl<'s> Session<'s> {
    /// Starts a session at power-on, with plans for the first scans.
    #[must_use]
    pub fn new(system: &'s System, tolerated: Tolerated, plans: Vec<Plan>) -> Self {
        let power_on = ScanState::power_on(system);
        Self { system, tolerated, power_on, scans: Vec::new(), plans, altered: usize::MAX, within: None, failure: None }
    }

    /// The system.
    #[must_use]
    pub fn system(&self) -> &'s System {
        self.system
    }

    /// Scans that have ended.
    #[must_use]
    pub fn scans(&self) -> &[Scan] {
        &self.scans
    }

    /// Number of scans planned, including those that have ended.
    #[must_use]
    pub fn planned(&self) -> usize {
        self.plans.len().max(self.scans.len())
    }

    /// Whether the scans that have ended follow the original plans.
    #[must_use]
    pub fn is_as_planned(&self) -> bool {
        self.scans.len() <= self.altered
    }

    /// State at the end of the last scan.
    #[must_use]
    pub fn state(&self) -> &ScanState {
        self.scans.last().and_then(|scan| scan.end.as_ref()).unwrap_or(&self.power_on)
    }

    /// State one scan earlier.
    fn earlier(&self) -> &ScanState {
        let before = self.scans.len().checked_sub(2).and_then(|position| self.scans[position].end.as_ref());
        before.unwrap_or(&self.power_on)
    }

    /// Whether a scan is under way.
    #[must_use]
    pub fn is_within(&self) -> bool {
        self.within.is_some()
    }

    /// Failure of the last scan.
    #[must_use]
    pub fn failure(&self) -> Option<Failure> {
        self.failure
    }

    /// Line to be executed next (from 0), if control is at a line or within it; the line after the last one is the end.
    #[must_use]
    pub fn line(&self) -> Option<usize> {
        match self.within.as_ref()?.replay.control() {
            PlaceRole::Line(line) | PlaceRole::Within(line, _) | PlaceRole::Hazard(line, _) => Some(line),
            _ => None,
        }
    }

    /// Current result, if control is in the program.
    #[must_use]
    pub fn result(&self) -> Option<(Type, u64)> {
        self.line().and(self.within.as_ref()).map(|within| within.replay.typed_result())
    }

    /// Current value of a variable.
    #[must_use]
    pub fn value(&self, variable: VarId) -> u64 {
        match &self.within {
            Some(within) => within.replay.value(variable),
            None => self.state().memory[variable.0],
        }
    }

    /// Whether a variable's value differs from that at the end of the previous scan.
    #[must_use]
    pub fn is_changed(&self, variable: VarId) -> bool {
        let before = if self.is_within() { self.state() } else { self.earlier() };
        self.value(variable) != before.memory[variable.0]
    }

    /// Current state of the token game.
    #[must_use]
    pub fn replay(&self) -> Replay<'s> {
        self.within.as_ref().map_or_else(|| Replay::after(self.system, self.state()), |within| within.replay.clone())
    }

    /// Transition that fires next, if the run can continue.
    #[must_use]
    pub fn next_transition(&self) -> Option<TransitionId> {
        self.go_on().ok()?;
        match &self.within {
            Some(within) => within.next().ok(),
            None => Within::new(self.system, self.state(), &self.plan()).ok()?.next().ok(),
        }
    }

    /// Plan of the next scan, or of the one under way.
    #[must_use]
    pub fn plan(&self) -> Plan {
        self.plans.get(self.scans.len()).cloned().unwrap_or_default()
    }

    /// Inputs that the next scan will read. A plant that cannot make the planned moves stays where it is.
    #[must_use]
    pub fn next_inputs(&self) -> Vec<(VarId, u64)> {
        let (from, plan) = (self.state(), self.plan());
        let plant = plan::moved(self.system, from, &plan.moves).unwrap_or_else(|_| from.plant.clone());
        plan::inputs(self.system, from, &plant, &plan)
    }

    /// Moves that the plant can make before the next scan, after those already planned.
    #[must_use]
    pub fn choices(&self) -> Vec<PlantMove> {
        let from = self.state();
        match plan::moved(self.system, from, &self.plan().moves) {
            Ok(plant) if !self.is_within() => (0..plant.len())
                .flat_map(|component| plan::enabled(self.system, from, &plant, component).map(|(chosen, _)| chosen))
                .collect(),
            _ => Vec::new(),
        }
    }

    /// Replaces the plan of the next scan and discards those after it.
    fn change(&mut self, plan: Plan) {
        self.altered = self.altered.min(self.scans.len());
        self.plans.resize(self.scans.len(), Plan::default());
        self.plans.push(plan);
    }

    /// Adds a plant move before the next scan.
    ///
    /// # Errors
    /// The plant cannot make the move, or a scan is under way.
    pub fn act(&mut self, chosen: PlantMove) -> Result<(), Stopped> {
        if self.is_within() {
            return Err(Stopped::UnderWay);
        }
        let mut plan = self.plan();
        plan.moves.push(chosen);
        plan::moved(self.system, self.state(), &plan.moves).map_err(Stopped::Plant)?;
        self.change(plan);
        Ok(())
    }

    /// Removes the last planned plant move.
    pub fn take_back(&mut self) {
        let mut plan = self.plan();
        if !self.is_within() && plan.moves.pop().is_some() {
            self.change(plan);
        }
    }

    /// Whether an input can be set now.
    ///
    /// # Errors
    /// The variable is not an input, the plant drives it, or a scan is under way.
    pub fn may_set(&self, input: VarId) -> Result<(), Stopped> {
        if self.system.program.variable(input).role != Role::Input {
            Err(Stopped::NoInput)
        } else if self.system.plant.driver(input).is_some() {
            Err(Stopped::Driven)
        } else if self.is_within() {
            Err(Stopped::UnderWay)
        } else {
            Ok(())
        }
    }

    /// Sets an input to a value, a bit pattern of its type, from the next scan on.
    ///
    /// # Errors
    /// As [`Session::may_set`], or the value lies outside the domain.
    pub fn set(&mut self, input: VarId, value: u64) -> Result<(), Stopped> {
        self.may_set(input)?;
        let domain = self.system.domain(input);
        if !domain.contains(domain.ty.number(value)) {
            return Err(Stopped::NoValue);
        }
        let mut plan = self.plan();
        plan.inputs.retain(|&(other, _)| other != input);
        plan.inputs.push((input, value));
        self.change(plan);
        Ok(())
    }

    /// Negates a Boolean input.
    ///
    /// # Errors
    /// As [`Session::set`].
    pub fn toggle(&mut self, input: VarId) -> Result<(), Stopped> {
        let now = self.next_inputs().into_iter().find(|&(other, _)| other == input).map_or(0, |(_, value)| value);
        self.set(input, now ^ 1)
    }

    /// Replaces the plan of the next scan by a random one.
    ///
    /// # Errors
    /// A scan is under way.
    pub fn draw_lots(&mut self, chance: &mut Chance<'s>) -> Result<(), Stopped> {
        if self.is_within() {
            return Err(Stopped::UnderWay);
        }
        let plan = chance.plan(self.state());
        self.change(plan);
        Ok(())
    }

    /// Executes the next scan, or the rest of the one under way.
    ///
    /// # Errors
    /// The plant cannot make a planned move, the scan never ends, or the one before failed.
    pub fn step_scan(&mut self) -> Result<(), Stopped> {
        self.go_on()?;
        let made = plan::scan(self.system, self.tolerated, self.state(), &self.plan());
        let (scan, failure) = made.map_err(Stopped::Plant)?;
        match failure {
            Some(failure) if scan.end.is_none() => Err(Stopped::Failed(failure)),
            _ => {
                self.finish(scan, failure);
                Ok(())
            }
        }
    }

    /// Checks that no failure ends the run.
    fn go_on(&self) -> Result<(), Stopped> {
        self.failure.map_or(Ok(()), |failure| Err(Stopped::Failed(failure)))
    }

    fn finish(&mut self, scan: Scan, failure: Option<Failure>) {
        let plan = self.plan();
        if self.plans.len() == self.scans.len() {
            self.plans.push(plan);
        }
        self.scans.push(scan);
        self.within = None;
        self.failure = failure;
    }

    /// Fires the next transition: of the plant, of the PLC's cycle, or of a line.
    ///
    /// # Errors
    /// The plant cannot make a planned move, or the scan before failed.
    pub fn step_transition(&mut self) -> Result<(), Stopped> {
        self.go_on()?;
        let mut within = match self.within.take() {
            Some(within) => within,
            None => Within::new(self.system, self.state(), &self.plan()).map_err(Stopped::Plant)?,
        };
        if within.fire().map_err(Stopped::Disagreement)? {
            let (scan, hazard) = within.end(self.tolerated, self.plan().moves);
            self.finish(scan, hazard.map(|(line, hazard)| Failure::Hazard(line, hazard)));
        } else {
            self.within = Some(within);
        }
        Ok(())
    }

    /// Executes the next line. Before a scan, goes to its first line; after its last line, ends it.
    ///
    /// # Errors
    /// As [`Session::step_transition`].
    pub fn step_line(&mut self) -> Result<(), Stopped> {
        loop {
            self.step_transition()?;
            if self.within.as_ref().is_none_or(Within::is_at_line) {
                return Ok(());
            }
        }
    }

    /// Goes back to the beginning of the scan under way, or of the previous one.
    ///
    /// # Errors
    /// The run is at power-on.
    pub fn back_scan(&mut self) -> Result<(), Stopped> {
        if self.within.take().is_none() {
            self.scans.pop().ok_or(Stopped::PowerOn)?;
        }
        self.failure = None;
        Ok(())
    }

    /// Takes back the last firing.
    ///
    /// # Errors
    /// The run is at power-on.
    pub fn back_transition(&mut self) -> Result<(), Stopped> {
        self.back_to(|fired, _| fired)
    }

    /// Takes back the last line.
    ///
    /// # Errors
    /// The run is at power-on.
    pub fn back_line(&mut self) -> Result<(), Stopped> {
        self.back_to(|_, line| line)
    }

    /// Goes back to a point of the scan chosen by its number of firings from two: before the last firing, and where
    /// control was last at a line before that; 0 is the beginning of the scan.
    fn back_to(&mut self, choose: impl Fn(usize, usize) -> usize) -> Result<(), Stopped> {
        let limit = self.within.as_ref().map(|within| within.fired);
        self.back_scan()?;
        let begin = |session: &Self| Within::new(session.system, session.state(), &session.plan());
        let mut within = begin(self).map_err(Stopped::Plant)?;
        let (mut fired, mut line) = (0, 0);
        while limit.is_none_or(|limit| within.fired + 1 < limit) {
            if within.fire().map_err(Stopped::Disagreement)? {
                break;
            }
            fired = within.fired;
            line = if within.is_at_line() { fired } else { line };
        }
        let target = choose(fired, line);
        let mut within = begin(self).map_err(Stopped::Plant)?;
        while within.fired < target {
            within.fire().map_err(Stopped::Disagreement)?;
        }
        self.within = (target > 0).then_some(within);
        Ok(())
    }

    /// Steps until a breakpoint is met, at least once. Returns whether it was met within `limit` scans, or firings if
    /// the breakpoint is about those. With `chance`, scans without a plan get a random one.
    ///
    /// # Errors
    /// As [`Session::step_scan`].
    pub fn run_until(
        &mut self,
        breakpoint: &Breakpoint,
        limit: usize,
        mut chance: Option<&mut Chance<'s>>,
    ) -> Result<bool, Stopped> {
        let mut watch = match breakpoint {
            Breakpoint::Scans(condition) => {
                let mut watch = Watch::new(condition, &self.power_on.memory);
                self.scans.iter().filter_map(|scan| scan.end.as_ref()).for_each(|end| _ = watch.see(&end.memory));
                Some(watch)
            }
            Breakpoint::Firings(_) => None,
        };
        for _ in 0..limit {
            let is_free = !self.is_within() && self.plans.len() == self.scans.len();
            if let Some(chance) = chance.as_deref_mut().filter(|_| is_free) {
                self.draw_lots(chance)?;
            }
            let is_met = match (breakpoint, &mut watch) {
                (Breakpoint::Firings(condition), _) => {
                    self.step_transition()?;
                    self.replay().holds(condition) == Some(true)
                }
                (Breakpoint::Scans(_), watch) => {
                    self.step_scan()?;
                    watch.as_mut().is_some_and(|watch| watch.see(&self.state().memory)) && self.failure.is_none()
                }
            };
            if is_met {
                return Ok(true);
            }
        }
        Ok(false)
    }
}
