//! Presentation of traces: a table of scans, and the instructions of a scan with the current result.

use super::columns::Columns;
use super::firing_trace::FiringTrace;
use super::fold::Piece;
use super::scan_trace::{Scan, ScanTrace};
use super::story::story;
use super::table::{Column, Table};
use crate::translate::{System, TransitionRole};
use petril_base::source::Source;
use petril_lang::flat::value_text;
use petril_lang::semantics::{Role, VarId};

/// Upper bound on changes listed for a folded stretch.
const MOST_MOVEMENTS: usize = 12;

/// Table with one row per scan: inputs, memory, outputs, and the plant's moves before the scan. A star marks a value
/// that differs from the one a scan earlier (for the first scan, from the one at power-on). The last scan of a lasso is
/// marked with the scan it repeats.
#[must_use]
pub fn scan_table(system: &System, trace: &ScanTrace) -> Table {
    let columns = Columns::chosen(&system.program, &|_| true);
    let pieces: Vec<Piece> = (0..trace.scans.len()).map(Piece::Scan).collect();
    piecewise_scan_table(system, trace, &Shown { columns, pieces, is_marked: &|_, _| false, is_ascii: false })
}

/// Selection and style of a table of scans.
pub struct Shown<'a> {
    /// Columns.
    pub columns: Columns,
    /// Scans, some of them folded.
    pub pieces: Vec<Piece>,
    /// Whether the value of a variable after a scan (from 0) is marked with an exclamation mark.
    pub is_marked: &'a dyn Fn(usize, VarId) -> bool,
    /// Whether only ASCII is used apart from names.
    pub is_ascii: bool,
}

/// Table in the form of [`scan_table`] for a selection of variables, with one line per folded stretch.
#[must_use]
pub fn piecewise_scan_table(system: &System, trace: &ScanTrace, shown: &Shown<'_>) -> Table {
    let program = &system.program;
    let head = |ids: &Vec<VarId>| ids.iter().map(|&id| Column::right(&program.variable(id).name)).collect();
    let has_moves = trace.scans.iter().any(|scan| !scan.moves.is_empty());
    let mut heads = vec![vec![Column::right("scan")]];
    heads.extend(shown.columns.groups.iter().map(head));
    heads.push(if has_moves { vec![Column::left("plant, before the scan")] } else { vec![] });
    let mut table = Table::new(heads);
    let power_on: Vec<u64> = program.variables.iter().map(|variable| variable.initial).collect();
    let (dots, arrow) = if shown.is_ascii { ("...", "->") } else { ("…", "→") };
    for piece in &shown.pieces {
        let position = match piece {
            Piece::Scan(position) => *position,
            Piece::Fold(fold) => {
                let mut movements = fold.movements(program, arrow);
                if let Some(more @ 1..) = movements.len().checked_sub(MOST_MOVEMENTS) {
                    movements.truncate(MOST_MOVEMENTS);
                    movements.push(format!("{more} more"));
                }
                let what =
                    if movements.is_empty() { " alike".to_owned() } else { format!(": {}", movements.join(", ")) };
                table.across(&format!("{dots} {}{what} {dots}", fold.title()));
                continue;
            }
        };
        let scan = &trace.scans[position];
        let end_of = |scan: &Scan| scan.end.as_ref().map(|end| end.memory.clone());
        let before = position.checked_sub(1).and_then(|before| end_of(&trace.scans[before]));
        let before = before.unwrap_or_else(|| power_on.clone());
        let mut memory = before.clone();
        match end_of(scan) {
            Some(end) => memory = end,
            None => scan.inputs.iter().for_each(|&(input, value)| memory[input.0] = value),
        }
        let repeats = trace.loop_start.filter(|_| position + 1 == trace.scans.len());
        let repeats = repeats.map(|start| format!(" = {}", start + 1)).unwrap_or_default();
        let mut row = vec![format!("{}{repeats}", position + 1)];
        for id in shown.columns.iter() {
            let unknown = scan.end.is_none() && program.variable(id).role != Role::Input;
            let star = if memory[id.0] == before[id.0] { "" } else { "*" };
            let value = program.value_text(id, memory[id.0]);
            let mark = if (shown.is_marked)(position, id) { "!" } else { "" };
            row.push(if unknown { "?".to_owned() } else { format!("{mark}{star}{value}") });
        }
        if has_moves {
            row.push(scan.done(system));
        }
        table.row(&row);
    }
    table
}

/// Table of the instructions executed in a scan, each with the current result after it, the variable it changed, and
/// the hazard it met.
///
/// A scan that never ends is listed until its state repeats.
#[must_use]
pub fn line_by_line(system: &System, trace: &ScanTrace, scan: usize, source: &Source) -> Table {
    let program = &system.program;
    let mut table = Table::new(vec![
        vec![Column::right("line"), Column::left("instruction")],
        vec![Column::right("CR"), Column::left("changes")],
        vec![Column::right("source"), Column::left("text")],
    ]);
    // A trace that does not replay has no verdict and is not shown.
    let told = story(system, trace, scan, usize::MAX).unwrap_or_default().unwrap_or_default();
    for executed in told.iter().take(1).flat_map(|scan| &scan.instructions) {
        let code = &program.code[executed.line];
        let change = executed.writes.filter(|_| executed.changes);
        let change =
            change.map(|(id, value)| format!("{} = {}", program.variable(id).name, program.value_text(id, value)));
        let changes: Vec<String> = change.into_iter().chain(executed.hazard.map(|hazard| hazard.to_string())).collect();
        let from = source.line_of(code.span.start);
        table.row(&[
            (executed.line + 1).to_string(),
            program.text(code.instruction),
            value_text(executed.ty, executed.result),
            changes.join(", "),
            from.to_string(),
            source.line_text(from).to_owned(),
        ]);
    }
    table
}

/// Table of a firing sequence: each firing, the scan it belongs to, and the instruction it executes. The last firing of
/// a lasso is marked with the firing after which the marking was the same.
#[must_use]
pub fn firing_table(system: &System, trace: &FiringTrace) -> Table {
    let mut table = Table::new(vec![
        vec![Column::right("firing"), Column::right("scan")],
        vec![Column::left("transition")],
        vec![Column::left("instruction")],
    ]);
    let mut scan = 0;
    for (position, &transition) in trace.firings.iter().enumerate() {
        let role = system.transitions[transition.index()];
        scan += usize::from(role == TransitionRole::Block);
        let instruction = match role {
            TransitionRole::Line(line) => system.program.text(system.program.code[line].instruction),
            _ => String::new(),
        };
        let repeats = trace.loop_start.filter(|_| position + 1 == trace.firings.len());
        let repeats = repeats.map(|start| format!(" = {start}")).unwrap_or_default();
        table.row(&[
            format!("{}{repeats}", position + 1),
            scan.to_string(),
            system.net.transition(transition).name.to_owned(),
            instruction,
        ]);
    }
    table
}
