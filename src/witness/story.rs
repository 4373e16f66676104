//! Scans told instruction by instruction, as data: what fired, what each instruction gave and wrote. Every form of a report
//! that goes into a scan tells it from here.

use super::firing_trace::{FiringTrace, replay_firings};
use super::replay::{Disagreement, Replay};
use super::scan_trace::{Event, ScanTrace, play_scans};
use crate::net::TransitionId;
use crate::translate::{System, TransitionRole};
use petril_lang::flat::{Hazard, Instruction, Target};
use petril_lang::semantics::{Type, VarId};

/// An instruction that was executed, on the net and by the interpreter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Executed {
    /// The line of flat code, from 0.
    pub line: usize,
    /// The current result after it, as a pattern of its type.
    pub result: u64,
    /// The type of the current result.
    pub ty: Type,
    /// The variable it wrote, with the value it left there.
    pub writes: Option<(VarId, u64)>,
    /// Whether the variable had another value before.
    pub changes: bool,
    /// The hazard it met.
    pub hazard: Option<Hazard>,
    /// The transitions that fired, in the order of time.
    pub firings: Vec<TransitionId>,
}

/// A scan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ToldScan {
    /// What fired before the program began: the plant's transitions, `block`, the copying of inputs.
    pub opening: Vec<TransitionId>,
    /// The instructions.
    pub instructions: Vec<Executed>,
    /// What fired after the program: `unblock`. Nothing if the scan does not end.
    pub closing: Vec<TransitionId>,
}

/// Tells the scans of a run from position `from` on; nothing if that takes more than `limit` instructions. A scan that never
/// ends is told until its state repeats, one that meets an error that ends it until then.
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

/// A firing of the transition view, and what it did to the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ToldFiring {
    /// The transition.
    pub transition: TransitionId,
    /// The instruction, if this was its last step.
    pub executed: Option<Executed>,
    /// The input a bit of which was copied, with its value then.
    pub copied: Option<(VarId, u64)>,
}

/// Tells a firing sequence.
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

/// Gathers firings to instructions.
struct Teller<'s> {
    system: &'s System,
    /// The values before the instruction that is being executed.
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

    /// The program is about to begin.
    fn begin(&mut self, replay: &Replay<'_>) {
        self.memory = replay.memory();
        self.hazards = 0;
        self.scan.opening = std::mem::take(&mut self.firings);
    }

    fn end(&mut self) -> ToldScan {
        self.scan.closing = std::mem::take(&mut self.firings);
        std::mem::take(&mut self.scan)
    }

    /// A transition has fired. Gives the instruction if it was the last step of one.
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
