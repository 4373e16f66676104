//! Traces of the scan view: plant moves, inputs and final state of each scan.

use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

use super::recalled::Recalled;
use super::replay::{Disagreement, Replay};
use crate::scans::{Failure, ScanRun, ScanSpace, ScanState};
use crate::translate::{PlaceRole, System, TransitionRole};
use petril_lang::flat::Hazard;
use petril_lang::semantics::{Role, VarId};
use petril_logic::Bound;
use petril_net::net::{Marking, TransitionId};

/// Run as a list of scans.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ScanTrace {
    /// Scans from power-on.
    pub scans: Vec<Scan>,
    /// For a lasso, the position of the scan whose end the last scan repeats.
    pub loop_start: Option<usize>,
}

/// Scan of a trace.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Scan {
    /// Moves of the plant before the scan.
    pub moves: Vec<PlantMove>,
    /// Values copied to the inputs.
    pub inputs: Vec<(VarId, u64)>,
    /// State at the end; `None` if the scan never ends.
    pub end: Option<ScanState>,
    /// First error of the scan, with its line (from 0). The rest of the scan and the state at its end are computed as
    /// if the hazard were tolerated.
    pub hazard: Option<(usize, Hazard)>,
}

impl Scan {
    /// Names of the plant's transitions before the scan.
    #[must_use]
    pub fn done(&self, system: &System) -> String {
        let names = self.moves.iter().map(|chosen| chosen.name(system));
        names.collect::<Vec<_>>().join(", ")
    }
}

/// Firing of a plant transition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlantMove {
    /// Component of the plant.
    pub component: usize,
    /// Position in the component's list of transitions.
    pub transition: usize,
}

impl PlantMove {
    /// Name of the transition.
    #[must_use]
    pub fn name(self, system: &System) -> &str {
        &system.plant.components[self.component].transitions[self.transition].name
    }
}

/// Trace along packed scan states, as by [`scan_trace`], with one more scan: the first that `pick` accepts.
#[must_use]
pub fn scan_trace_to(
    space: &ScanSpace<'_>,
    states: &[&[u64]],
    pick: &dyn Fn(&ScanRun<'_>) -> bool,
) -> Option<ScanTrace> {
    let mut trace = scan_trace(space, states, None, None);
    let before = states.last().map_or_else(|| space.power_on(), |state| space.unpack(state));
    trace.scans.push(picked(space, &before, pick)?);
    Some(trace)
}

/// Trace of consecutive packed scan states, the first being one after the first scan.
///
/// With `loop_start`, one more scan returns to the state at that position. With `failing`, a scan that fails in this
/// way is appended to the last state (to power-on if there is none).
#[must_use]
pub fn scan_trace(
    space: &ScanSpace<'_>,
    states: &[&[u64]],
    loop_start: Option<usize>,
    failing: Option<Failure>,
) -> ScanTrace {
    let system = space.system();
    let inputs = |memory: &dyn Fn(VarId) -> u64| -> Vec<(VarId, u64)> {
        system.program.with_role(Role::Input).map(|input| (input, memory(input))).collect()
    };
    let mut before = space.power_on();
    let mut scans = Vec::new();
    for state in states.iter().copied().chain(loop_start.map(|start| states[start])) {
        let end = space.unpack(state);
        let inputs = inputs(&|input| end.memory[input.0]);
        scans.push(Scan { moves: moves(system, &before, &end.plant), inputs, end: Some(end.clone()), hazard: None });
        before = end;
    }
    if failing.is_some() {
        scans.extend(picked(space, &before, &|run| run.end.err() == failing));
    }
    ScanTrace { scans, loop_start }
}

/// The first scan from a state that `pick` accepts.
fn picked(space: &ScanSpace<'_>, before: &ScanState, pick: &dyn Fn(&ScanRun<'_>) -> bool) -> Option<Scan> {
    let system = space.system();
    let mut picked = None;
    space.scans(before, &mut |run| {
        if picked.is_some() || !pick(&run) {
            return;
        }
        let inputs = system.program.with_role(Role::Input).map(|input| (input, run.machine.value(input))).collect();
        let memory = || (0..system.program.variables.len()).map(|id| run.machine.value(VarId(id))).collect();
        let end = run.machine.at_end().then(|| ScanState { plant: run.plant.to_vec(), memory: memory() });
        let hazard = match run.end {
            Err(Failure::Hazard(line, hazard)) => Some((line, hazard)),
            _ => None,
        };
        picked = Some(Scan { moves: moves(system, before, run.plant), inputs, end, hazard });
    });
    picked
}

/// Moves that bring the plant from its state at the end of a scan to the given markings.
fn moves(system: &System, before: &ScanState, plant: &[usize]) -> Vec<PlantMove> {
    let components = system.plant.components.iter().zip(before.plant.iter().zip(plant)).enumerate();
    let paths = components.filter_map(|(i, (component, (&from, &to)))| {
        let path = component.path(from, to, |output| before.memory[output.0])?;
        Some(path.into_iter().map(move |transition| PlantMove { component: i, transition }))
    });
    paths.flatten().collect()
}

/// Valuation of state formulas at a position; `None` for a temporal formula.
pub type Holds<'a> = &'a dyn Fn(&Bound) -> Option<bool>;

/// Replays a trace and calls `at_end` at the end of each scan with its position and the history of the run.
///
/// # Errors
/// The trace is not one of the system, or `at_end` finds that it does not show the expected facts.
pub fn replay_scans(
    system: &System,
    trace: &ScanTrace,
    at_end: impl FnMut(usize, &Recalled) -> Result<(), Disagreement>,
) -> Result<(), Disagreement> {
    replay_lines(system, trace, |_, _, _| {}, at_end)
}

/// As [`replay_scans`]; also calls `at_line` whenever control reaches a line, with the position of the scan, the
/// replay, and the history of the scans before.
///
/// # Errors
/// As for [`replay_scans`].
pub fn replay_lines(
    system: &System,
    trace: &ScanTrace,
    mut at_line: impl FnMut(usize, &Replay<'_>, &Recalled),
    mut at_end: impl FnMut(usize, &Recalled) -> Result<(), Disagreement>,
) -> Result<(), Disagreement> {
    let mut recalled = Recalled::new(Replay::new(system).memory());
    play_scans(system, trace, &mut |event, replay| {
        match event {
            Event::AtLine(position) => at_line(position, replay, &recalled),
            Event::AtEnd(position) => {
                recalled.push(replay.memory());
                recalled.mark(replay.marking().clone());
                at_end(position, &recalled)?;
            }
            _ => {}
        }
        Ok(())
    })
}

/// Event of a replay.
pub enum Event {
    /// The inputs have been copied; the program begins.
    Begins,
    /// Control has reached a line in the scan at this position.
    AtLine(usize),
    /// A transition has fired.
    Fired(TransitionId),
    /// The scan at this position has reached its end.
    AtEnd(usize),
    /// The scan is over, or never ends.
    Ended,
}

/// Listener for events of a replay.
type Seen<'a> = &'a mut dyn FnMut(Event, &Replay<'_>) -> Result<(), Disagreement>;

/// Replays a trace and reports its events.
pub fn play_scans(system: &System, trace: &ScanTrace, seen: Seen<'_>) -> Result<(), Disagreement> {
    let mut replay = Replay::new(system);
    let end_place = PlaceRole::Line(system.program.end());
    for (position, scan) in trace.scans.iter().enumerate() {
        let in_scan = |Disagreement(what)| Disagreement(format!("in scan {}: {what}", position + 1));
        for &PlantMove { component, transition } in &scan.moves {
            fire(&mut replay, seen, &|role| role == TransitionRole::Plant { component, transition })
                .map_err(in_scan)?;
        }
        fire(&mut replay, seen, &|role| role == TransitionRole::Block).map_err(in_scan)?;
        for &(variable, pattern) in &scan.inputs {
            for bit in (0..system.program.variable(variable).bits).rev() {
                let copy = TransitionRole::Copy { variable, bit, value: pattern >> bit & 1 == 1 };
                fire(&mut replay, seen, &|role| role == copy).map_err(in_scan)?;
            }
        }
        seen(Event::Begins, &replay)?;
        let mut met = Met::new(scan.end.is_some());
        while !replay.is_at(end_place) && (replay.is_within_line() || met.is_new(replay.marking())) {
            if !replay.is_within_line() {
                seen(Event::AtLine(position), &replay)?;
            }
            fire(&mut replay, seen, &|role| matches!(role, TransitionRole::Line(_))).map_err(in_scan)?;
            if scan.end.is_none() && scan.hazard.is_some_and(|hazard| replay.hazards().contains(&hazard)) {
                return seen(Event::Ended, &replay);
            }
        }
        if scan.hazard.is_some_and(|hazard| !replay.hazards().contains(&hazard)) {
            return Err(in_scan(Disagreement("it does not meet this hazard".to_owned())));
        }
        let Some(end) = &scan.end else {
            let ends = replay.is_at(end_place);
            return if ends { Err(in_scan(Disagreement("it ends".to_owned()))) } else { seen(Event::Ended, &replay) };
        };
        if !replay.is_at(end_place) {
            return Err(in_scan(Disagreement("it never ends".to_owned())));
        }
        compare(system, &replay, end).map_err(in_scan)?;
        seen(Event::AtEnd(position), &replay).map_err(in_scan)?;
        fire(&mut replay, seen, &|role| role == TransitionRole::Unblock).map_err(in_scan)?;
        seen(Event::Ended, &replay)?;
    }
    // Both ends have been compared with the net, so equal ends mean equal states.
    let end = |position: usize| trace.scans.get(position).map(|scan| &scan.end);
    match trace.loop_start {
        Some(start) if start + 1 >= trace.scans.len() || end(start) != end(trace.scans.len() - 1) => {
            Err(Disagreement("the lasso does not close".to_owned()))
        }
        _ => Ok(()),
    }
}

/// Markings seen in a scan; one that recurs shows that the scan never ends.
enum Met {
    /// Every marking: the trace stops at the first that recurs.
    All(BTreeSet<Marking>),
    /// One marking, replaced after each power of two lines. Once in a cycle, one of its markings is eventually kept (R.
    /// P. Brent, An improved Monte Carlo factorization algorithm, BIT 20, 1980).
    One { kept: Option<Marking>, steps: u64 },
}

impl Met {
    fn new(ends: bool) -> Self {
        if ends { Self::One { kept: None, steps: 0 } } else { Self::All(BTreeSet::new()) }
    }

    fn is_new(&mut self, marking: &Marking) -> bool {
        match self {
            Self::All(met) => met.insert(marking.clone()),
            Self::One { kept, steps } => {
                let is_new = kept.as_ref() != Some(marking);
                *steps += 1;
                // The first marking is kept late: most scans are short.
                if *steps >= 1024 && steps.is_power_of_two() {
                    *kept = Some(marking.clone());
                }
                is_new
            }
        }
    }
}

/// Fires the only enabled transition among those with these roles, and reports it.
fn fire(replay: &mut Replay<'_>, seen: Seen<'_>, of: &dyn Fn(TransitionRole) -> bool) -> Result<(), Disagreement> {
    let transition = replay.fire_only(of)?;
    seen(Event::Fired(transition), replay)
}

/// Compares the final state found by the search with the net.
fn compare(system: &System, replay: &Replay<'_>, end: &ScanState) -> Result<(), Disagreement> {
    let memory = replay.memory();
    if let Some(variable) = system.program.declared().find(|id| memory[id.0] != end.memory[id.0]) {
        let name = &system.program.variable(variable).name;
        return Err(Disagreement(format!("the search has another value of `{name}` at its end than the net")));
    }
    for (i, (component, &marking)) in system.plant.components.iter().zip(&end.plant).enumerate() {
        let own = system.net.place_ids().filter(|id| system.places[id.index()] == PlaceRole::Plant(i));
        let marked: Vec<usize> =
            own.enumerate().filter(|&(_, id)| replay.marking().is_marked(id)).map(|(place, _)| place).collect();
        if marked != component.markings[marking].marked {
            return Err(Disagreement(format!("the search has another marking of `{}` than the net", component.name)));
        }
    }
    Ok(())
}
