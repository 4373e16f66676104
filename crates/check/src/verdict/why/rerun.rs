//! Repetition of a run with other inputs.

use std::cell::Cell;
use std::rc::Rc;

use crate::scans::Position;
use crate::verdict::Change;
use crate::verdict::views::ScanStates;
use crate::witness::ScanTrace;
use petril_lang::semantics::VarId;

/// Iterations after which a loop that has not closed is given up.
const ROUNDS: usize = 64;

/// State at the end of a scan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct End {
    /// Values, and the possible markings of the devices.
    pub position: Position,
    /// Packed state, with one possible marking of each device.
    pub packed: Vec<u64>,
    /// Memory of past-time formulas.
    pub memory: Vec<u64>,
}

/// A run that can be repeated. The inputs of a loop are repeated for ever.
pub struct Rerun<'a> {
    scans: &'a dyn ScanStates,
    trace: &'a ScanTrace,
    /// States of the original run, one after each scan.
    ends: Vec<Rc<End>>,
    /// Number of scans computed.
    computed: Cell<usize>,
    /// Whether some repetition was given up because its loop did not close.
    gave_up: Cell<bool>,
}

/// A repeated run.
pub struct Again {
    /// States after each scan; for a lasso, the last one repeats the state at `loop_start`.
    pub ends: Vec<Rc<End>>,
    /// For a lasso, the position repeated by the last state.
    pub loop_start: Option<usize>,
}

impl Again {
    /// Number of states, with the repeated one of a lasso counted once.
    pub fn length(&self) -> usize {
        self.ends.len() - usize::from(self.loop_start.is_some())
    }
}

impl<'a> Rerun<'a> {
    /// Repeats the run unchanged; `None` if that fails.
    pub fn new(scans: &'a dyn ScanStates, trace: &'a ScanTrace) -> Option<Self> {
        let mut rerun = Self { scans, trace, ends: Vec::new(), computed: Cell::new(0), gave_up: Cell::new(false) };
        rerun.ends = rerun.with(&[])?.ends;
        Some(rerun)
    }

    /// The unchanged run.
    pub fn itself(&self) -> Again {
        Again { ends: self.ends.clone(), loop_start: self.trace.loop_start }
    }

    /// The trace of the original run.
    pub fn trace(&self) -> &ScanTrace {
        self.trace
    }

    /// Whether the outcome of some repetition is unknown.
    pub fn gave_up(&self) -> bool {
        self.gave_up.get()
    }

    /// Number of scans computed so far.
    pub fn computed(&self) -> usize {
        self.computed.get()
    }

    /// Repeats the run with changed inputs; `None` if the system has no such run, or its loop does not close.
    pub fn with(&self, changes: &[Change]) -> Option<Again> {
        let first = changes.iter().map(|change| change.scan).min().unwrap_or(0);
        let mut ends = self.ends.get(..first).unwrap_or_default().to_vec();
        for scan in first..self.trace.scans.len() {
            self.scan(scan, changes, &mut ends)?;
        }
        let Some(start) = self.trace.loop_start else { return Some(Again { ends, loop_start: None }) };
        // Positions at which an iteration of the loop begins.
        let mut turns = vec![start, ends.len() - 1];
        for _ in 0..ROUNDS {
            let last = ends.last()?;
            if let Some(&turn) = turns[..turns.len() - 1].iter().find(|&&turn| ends[turn] == *last) {
                return Some(Again { ends, loop_start: Some(turn) });
            }
            for scan in start + 1..self.trace.scans.len() {
                self.scan(scan, changes, &mut ends)?;
            }
            turns.push(ends.len() - 1);
        }
        self.gave_up.set(true);
        None
    }

    /// Executes one scan and appends its end.
    fn scan(&self, scan: usize, changes: &[Change], ends: &mut Vec<Rc<End>>) -> Option<()> {
        self.computed.set(self.computed.get() + 1);
        let changed = |&(input, value): &(VarId, u64)| {
            let change = changes.iter().find(|change| (change.scan, change.input) == (scan, input));
            (input, change.map_or(value, |change| change.to))
        };
        let inputs: Vec<(VarId, u64)> = self.trace.scans[scan].inputs.iter().map(changed).collect();
        let (space, before) = (&self.scans.base().space, ends.last());
        let position = match before {
            Some(before) => space.scan_reading(&before.position, &inputs)?,
            None => space.scan_reading(&space.beginning(), &inputs)?,
        };
        let packed = space.packed_position(&position);
        let before = before.map(|before| (before.packed.as_slice(), before.memory.as_slice()));
        let memory = self.scans.remember(before, &packed);
        ends.push(Rc::new(End { position, packed, memory }));
        Some(())
    }
}
