//! A run made again with other inputs.

use std::cell::Cell;
use std::rc::Rc;

use crate::explore::Position;
use crate::verdict::Change;
use crate::verdict::views::ScanStates;
use crate::witness::ScanTrace;
use petril_lang::semantics::VarId;

/// Rounds of a loop after which nobody waits any longer for it to close.
const ROUNDS: usize = 64;

/// Where a run is at the end of a scan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct End {
    /// The values, and the markings of the devices that fit.
    pub position: Position,
    /// The same packed, with some of these markings.
    pub packed: Vec<u64>,
    /// What is remembered.
    pub memory: Vec<u64>,
}

/// A run, to be made again. The inputs of a loop are repeated for ever.
pub struct Rerun<'a> {
    scans: &'a dyn ScanStates,
    trace: &'a ScanTrace,
    /// Where the run itself was after each scan.
    ends: Vec<Rc<End>>,
    /// Scans that were computed.
    computed: Cell<usize>,
    /// Some run went on without coming to a loop.
    gave_up: Cell<bool>,
}

/// A run that was made again.
pub struct Again {
    /// Where it was after each scan; of a loop, the last one is where it closes.
    pub ends: Vec<Rc<End>>,
    /// For a lasso, the position that the last one repeats.
    pub loop_start: Option<usize>,
}

impl Again {
    /// How many states there are, the last one of a loop not counted twice.
    pub fn length(&self) -> usize {
        self.ends.len() - usize::from(self.loop_start.is_some())
    }
}

impl<'a> Rerun<'a> {
    /// The run as it is. `None` if it cannot be made again.
    pub fn new(scans: &'a dyn ScanStates, trace: &'a ScanTrace) -> Option<Self> {
        let mut rerun = Self { scans, trace, ends: Vec::new(), computed: Cell::new(0), gave_up: Cell::new(false) };
        rerun.ends = rerun.with(&[])?.ends;
        Some(rerun)
    }

    /// The run as it is.
    pub fn itself(&self) -> Again {
        Again { ends: self.ends.clone(), loop_start: self.trace.loop_start }
    }

    /// The run.
    pub fn trace(&self) -> &ScanTrace {
        self.trace
    }

    /// Whether it is not known of some run what becomes of it.
    pub fn gave_up(&self) -> bool {
        self.gave_up.get()
    }

    /// Scans that were computed so far.
    pub fn computed(&self) -> usize {
        self.computed.get()
    }

    /// The run with other inputs. `None` if the system has no such run, or it does not come to a loop.
    pub fn with(&self, changes: &[Change]) -> Option<Again> {
        let first = changes.iter().map(|change| change.scan).min().unwrap_or(0);
        let mut ends = self.ends.get(..first).unwrap_or_default().to_vec();
        for scan in first..self.trace.scans.len() {
            self.scan(scan, changes, &mut ends)?;
        }
        let Some(start) = self.trace.loop_start else { return Some(Again { ends, loop_start: None }) };
        // Where the loop begins again and again.
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

    /// Appends the end of one scan.
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
