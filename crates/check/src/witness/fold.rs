//! Folding of long runs: stretches in which only clocks and counters advance become one line.

use std::collections::BTreeSet;

use super::scan_trace::ScanTrace;
use petril_lang::flat::FlatProgram;
use petril_lang::semantics::{Role, VarId};

/// Lower bound on the length of a folded stretch, in scans.
const LEAST: usize = 8;

/// Upper bound on the period of a folded stretch, in scans.
const LONGEST_PERIOD: usize = 4;

/// Part of a run as shown. Scans are positions in the run, from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece {
    /// Scan shown in full.
    Scan(usize),
    /// Stretch of scans summarised in one line.
    Fold(Fold),
}

/// Stretch of scans that repeat the scans before it, except for numbers that advance in equal steps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fold {
    /// First scan of the stretch.
    pub first: usize,
    /// Last scan of the stretch.
    pub last: usize,
    /// Period of the pattern in scans; 1 if all scans are alike.
    pub period: usize,
    /// Numbers that advance, in the order of the columns.
    pub moved: Vec<Moved>,
    /// Variables that alternate, with their values in the first period of the stretch, one value per scan.
    pub turns: Vec<(VarId, Vec<u64>)>,
}

/// Number that advances during a stretch. Values are bit patterns of its type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moved {
    /// Variable.
    pub variable: VarId,
    /// Value before the stretch.
    pub from: u64,
    /// Value at the end of the stretch.
    pub to: u64,
}

impl Fold {
    /// Number of scans in the stretch.
    #[must_use]
    pub fn scans(&self) -> usize {
        self.last - self.first + 1
    }

    /// Number of scans, in words: "498 scans", "996 scans, every 2 alike".
    #[must_use]
    pub fn title(&self) -> String {
        match self.period {
            1 => format!("{} scans", self.scans()),
            period => format!("{} scans, every {period} alike", self.scans()),
        }
    }

    /// Changes in words: "n 1 → 499", "Pulse 0, 1 in turn".
    #[must_use]
    pub fn movements(&self, program: &FlatProgram, arrow: &str) -> Vec<String> {
        let moved = self.moved.iter().map(|&Moved { variable, from, to }| {
            let value = |pattern| program.value_text(variable, pattern);
            format!("{} {} {arrow} {}", program.variable(variable).name, value(from), value(to))
        });
        let turns = self.turns.iter().map(|(variable, values)| {
            let values: Vec<String> = values.iter().map(|&value| program.value_text(*variable, value)).collect();
            format!("{} {} in turn", program.variable(*variable).name, values.join(", "))
        });
        moved.chain(turns).collect()
    }
}

/// Splits a run into pieces, judged by the variables shown. Scans in `kept` are always shown, and so are the first
/// scan, the last one, scans that meet an error, and the scan a lasso loops back to.
///
/// A scan continues a stretch of period *p* if each input and Boolean has its value of *p* scans earlier, each computed
/// number makes the step it made *p* scans earlier, and the plant makes the same moves.
#[must_use]
pub fn fold(program: &FlatProgram, trace: &ScanTrace, shown: &[VarId], kept: &BTreeSet<usize>) -> Vec<Piece> {
    let folding = Folding { program, trace, shown, kept };
    let count = trace.scans.len();
    let mut pieces = Vec::new();
    let mut at = 0;
    while at < count {
        let stretch = (1..=LONGEST_PERIOD).find_map(|period| {
            let end = (at..count).find(|&scan| !folding.continues(scan, period)).unwrap_or(count);
            (end - at >= LEAST).then(|| folding.fold(at, end - 1, period))
        });
        match stretch {
            Some(fold) => {
                at = fold.last + 1;
                pieces.push(Piece::Fold(fold));
            }
            None => {
                pieces.push(Piece::Scan(at));
                at += 1;
            }
        }
    }
    pieces
}

struct Folding<'a> {
    program: &'a FlatProgram,
    trace: &'a ScanTrace,
    shown: &'a [VarId],
    kept: &'a BTreeSet<usize>,
}

impl Folding<'_> {
    /// Value after this number of scans.
    fn value(&self, scans: usize, variable: VarId) -> Option<u64> {
        match scans.checked_sub(1) {
            None => Some(self.program.variable(variable).initial),
            Some(scan) => Some(self.trace.scans.get(scan)?.end.as_ref()?.memory[variable.0]),
        }
    }

    fn continues(&self, scan: usize, period: usize) -> bool {
        let scans = &self.trace.scans;
        let is_shown = scan + 1 == scans.len()
            || self.trace.loop_start == Some(scan)
            || scans[scan].hazard.is_some()
            || self.kept.contains(&scan);
        !is_shown
            && scan >= period
            && scans[scan].moves == scans[scan - period].moves
            && self.shown.iter().all(|&variable| self.repeats(scan, period, variable) == Some(true))
    }

    fn repeats(&self, scan: usize, period: usize, variable: VarId) -> Option<bool> {
        let now = self.value(scan + 1, variable)?;
        let then = self.value(scan + 1 - period, variable)?;
        if !self.may_go_on(variable) {
            return Some(now == then);
        }
        let number = |pattern| self.program.variable(variable).ty.number(pattern);
        let (before_now, before_then) = (self.value(scan, variable)?, self.value(scan - period, variable)?);
        Some(number(now) - number(before_now) == number(then) - number(before_then))
    }

    /// Whether a variable is a number computed by the program.
    fn may_go_on(&self, variable: VarId) -> bool {
        let variable = self.program.variable(variable);
        variable.role != Role::Input && !variable.ty.is_bool()
    }

    fn fold(&self, first: usize, last: usize, period: usize) -> Fold {
        let (mut moved, mut turns) = (Vec::new(), Vec::new());
        for &variable in self.shown {
            let values: Vec<u64> = (first..first + period).filter_map(|scan| self.value(scan + 1, variable)).collect();
            let (from, to) = (self.value(first, variable), self.value(last + 1, variable));
            // A number that differs after a period advances.
            if let (Some(from), Some(to), true) = (from, to, values.last() != from.as_ref()) {
                moved.push(Moved { variable, from, to });
            } else if values.windows(2).any(|pair| pair[0] != pair[1]) {
                turns.push((variable, values));
            }
        }
        Fold { first, last, period, moved, turns }
    }
}
