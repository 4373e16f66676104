//! Runs as data, instruction by instruction: firings, results and writes. Source of every report form that shows the
//! inside of a scan.

use super::firing_trace::{FiringTrace, replay_firings};
use super::replay::{Disagreement, Replay};
use super::scan_trace::{Event, ScanTrace, play_scans};
use crate::translate::{System, TransitionRole};
use petril_lang::flat::{Hazard, Instruction, Target};
use petril_lang::semantics::{Type, VarId};
use petril_net::net::TransitionId;

/// Instruction executed on the net and by the interpreter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Executed {
    /// Line of flat code, from 0.
    pub line: usize,
    /// Current result after the instruction, as a bit pattern of its type.
    pub result: u64,
    /// Type of the current result.
    pub ty: Type,
    /// Variable written, with its new value.
    pub writes: Option<(VarId, u64)>,
    /// Whether the value differs from the one before.
    pub changes: bool,
    /// Hazard met.
    pub hazard: Option<Hazard>,
    /// Transitions fired, in chronological order.
    pub firings: Vec<TransitionId>,
}

/// A scan, instruction by instruction.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ToldScan {
    /// Transitions fired before the program began: the plant's, `block`, the copying of inputs.
    pub opening: Vec<TransitionId>,
    /// Instructions executed.
    pub instructions: Vec<Executed>,
    /// Transitions fired after the program: `unblock`. Empty if the scan does not end.
    pub closing: Vec<TransitionId>,
}

/// Lists the scans of a run from position `from` on; `None` if there are more than `limit` instructions. A scan that
/// never ends is listed until its state repeats, one ended by an error up to the error.
///
/// # Errors
/// The trace is not one of the system.
pub fn story(
    system: &System,
    trace: &ScanTrace,
    from: usize,
    limit: usize,
) -> Result<Option<Vec<ToldScan>>, Disagreement> {
    let mut teller = Teller::new(system);
    let mut told: Vec<ToldScan> = Vec::new();
    let (mut position, mut left, mut is_long) = (0, limit, false);
    let played = play_scans(system, trace, &mut |event, replay| {
        match event {
            Event::Begins => teller.begin(replay),
            Event::Fired(transition) => {
                if let Some(executed) = teller.fired(transition, replay).filter(|_| position >= from) {
                    is_long = left == 0;
                    left = left.checked_sub(1).ok_or_else(|| Disagreement("it is too long to tell".to_owned()))?;
                    teller.scan.instructions.push(executed);
                }
            }
            Event::AtLine(_) | Event::AtEnd(_) => {}
            Event::Ended => {
                let scan = teller.end();
                told.extend((position >= from).then_some(scan));
                position += 1;
            }
        }
        Ok(())
    });
    match played {
        Err(_) if is_long => Ok(None),
        played => played.map(|()| Some(told)),
    }
}

/// A firing of the transition view with its effect on the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ToldFiring {
    /// Transition fired.
    pub transition: TransitionId,
    /// Instruction completed by the firing, if any.
    pub executed: Option<Executed>,
    /// Input of which a bit was copied, with its value then.
    pub copied: Option<(VarId, u64)>,
}

/// Lists a firing sequence.
///
/// # Errors
/// The trace is not one of the system.
pub fn firing_story(system: &System, trace: &FiringTrace) -> Result<Vec<ToldFiring>, Disagreement> {
    let mut teller = Teller::new(system);
    let mut told = Vec::new();
    replay_firings(system, trace, |position, replay| {
        let Some(&transition) = position.checked_sub(1).and_then(|last| trace.firings.get(last)) else {
            teller.begin(replay);
            return Ok(());
        };
        let executed = teller.fired(transition, replay);
        let copied = match system.transitions[transition.index()] {
            TransitionRole::Copy { variable, .. } => Some((variable, replay.value(variable))),
            _ => None,
        };
        if copied.is_some() {
            teller.begin(replay);
        }
        told.push(ToldFiring { transition, executed, copied });
        Ok(())
    })?;
    Ok(told)
}

/// Groups firings by instruction.
struct Teller<'s> {
    system: &'s System,
    /// Values before the current instruction.
    memory: Vec<u64>,
    ty: Type,
    hazards: usize,
    firings: Vec<TransitionId>,
    scan: ToldScan,
}

impl<'s> Teller<'s> {
    fn new(system: &'s System) -> Self {
        let (memory, firings) = (Vec::new(), Vec::new());
        Self { system, memory, ty: Type::BOOL, hazards: 0, firings, scan: ToldScan::default() }
    }

    /// Starts the program of a scan.
    fn begin(&mut self, replay: &Replay<'_>) {
        self.memory = replay.memory();
        self.hazards = 0;
        self.scan.opening = std::mem::take(&mut self.firings);
    }

    fn end(&mut self) -> ToldScan {
        self.scan.closing = std::mem::take(&mut self.firings);
        std::mem::take(&mut self.scan)
    }

    /// Records a firing; returns the instruction it completes, if any.
    fn fired(&mut self, transition: TransitionId, replay: &Replay<'_>) -> Option<Executed> {
        self.firings.push(transition);
        let TransitionRole::Line(line) = self.system.transitions[transition.index()] else { return None };
        if replay.is_within_line() {
            return None;
        }
        let instruction = self.system.program.code[line].instruction;
        self.ty = instruction.gives().unwrap_or(self.ty);
        let result = replay.result() & self.ty.mask();
        let target = instruction.writes().map(|target| match target {
            Target::Variable(variable) => variable,
            Target::Element(element) => element.at(replay.value(element.index) as usize),
        });
        let sets = !matches!(instruction, Instruction::Set(_) | Instruction::Reset(_)) || result == 1;
        let writes = target.filter(|_| sets).map(|variable| (variable, replay.value(variable)));
        let mut changes = false;
        if let Some((variable, value)) = writes {
            changes = std::mem::replace(&mut self.memory[variable.0], value) != value;
        }
        let hazard = replay.hazards().get(self.hazards).map(|&(_, hazard)| hazard);
        self.hazards = replay.hazards().len();
        let firings = std::mem::take(&mut self.firings);
        Some(Executed { line, result, ty: self.ty, writes, changes, hazard, firings })
    }
}
