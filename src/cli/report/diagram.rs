//! Timing diagrams of traces: a row per variable, a cell per scan.

use petril::semantics::VarId;
use petril::translate::System;
use petril::witness::{Columns, Piece, Scan, ScanTrace};

/// Characters of a diagram.
pub struct Pen {
    low: char,
    high: char,
    rise: char,
    fall: char,
    change: char,
    gap: char,
}

/// Characters for any terminal.
pub const ASCII: Pen = Pen { low: '_', high: '"', rise: '/', fall: '\\', change: '|', gap: ':' };
/// Characters for Unicode terminals.
pub const UNICODE: Pen = Pen { low: '▁', high: '▔', rise: '╱', fall: '╲', change: '│', gap: '⋮' };

/// Maximum width of a number.
const WIDEST: usize = 10;

/// Cell of a row: a completed scan with the memory at its end and at the end of the scan before, or a fold.
enum Cell<'a> {
    Scan { number: usize, before: Option<&'a [u64]>, now: &'a [u64] },
    Gap,
}

/// Timing diagram of a trace: inputs as read by the scans, memory and outputs at their ends. Rows are split into blocks
/// of at most `width` columns.
pub fn diagram(
    system: &System,
    trace: &ScanTrace,
    (columns, pieces): (&Columns, &[Piece]),
    width: usize,
    pen: &Pen,
) -> String {
    let program = &system.program;
    let cells = pieces.iter().filter_map(|piece| match piece {
        Piece::Fold(_) => Some(Cell::Gap),
        Piece::Scan(scan) => Some(Cell::Scan {
            number: scan + 1,
            before: scan.checked_sub(1).and_then(|before| end_of(&trace.scans[before])),
            now: end_of(&trace.scans[*scan])?,
        }),
    });
    let cells: Vec<Cell<'_>> = cells.collect();
    let shown: Vec<VarId> = columns.iter().collect();
    let names =
        shown.iter().map(|&id| program.variable(id).name.chars().count()).chain(["scan".len()]).max().unwrap_or(0);
    let text = |memory: &[u64], id: VarId| program.value_text(id, memory[id.0]);
    let numbers = shown.iter().filter(|&&id| !program.variable(id).ty.is_bool());
    let widest = numbers.flat_map(|&id| {
        cells.iter().filter_map(move |cell| match cell {
            Cell::Scan { now, .. } => Some(text(now, id).chars().count()),
            Cell::Gap => None,
        })
    });
    let widest = widest.max().unwrap_or(0);
    let cell_width = (widest.min(WIDEST) + 1).max(trace.scans.len().to_string().len() + 1).max(4);
    let many = (width.saturating_sub(names + 1) / cell_width).max(1);
    let mut drawn = Vec::new();
    for part in cells.chunks(many) {
        let mut lines = vec![format!("{:<names$} {}", "scan", heads(part, cell_width, pen))];
        for &id in &shown {
            let variable = program.variable(id);
            let mut line = format!("{:<names$} ", variable.name);
            for (position, cell) in part.iter().enumerate() {
                let Cell::Scan { before, now, .. } = cell else {
                    line += &format!("{:<cell_width$}", format!(" {}", pen.gap));
                    continue;
                };
                let earlier = before.map_or(variable.initial, |before| before[id.0]);
                line += &if variable.ty.is_bool() {
                    level(earlier, now[id.0], cell_width, pen)
                } else {
                    let follows_gap = position.checked_sub(1).is_none_or(|before| matches!(part[before], Cell::Gap));
                    let is_new = earlier != now[id.0] || follows_gap;
                    number(&if is_new { text(now, id) } else { String::new() }, is_new, cell_width, pen)
                };
            }
            lines.push(line.trim_end().to_owned());
        }
        drawn.push(lines.join("\n") + "\n");
    }
    drawn.join("\n")
}

/// Memory at the end of a scan.
fn end_of(scan: &Scan) -> Option<&[u64]> {
    scan.end.as_ref().map(|end| end.memory.as_slice())
}

/// Header row with the scan numbers.
fn heads(cells: &[Cell<'_>], width: usize, pen: &Pen) -> String {
    let heads = cells.iter().map(|cell| match cell {
        Cell::Scan { number, .. } => format!(" {number:<rest$}", rest = width - 1),
        Cell::Gap => format!("{:<width$}", format!(" {}", pen.gap)),
    });
    heads.collect::<String>().trim_end().to_owned()
}

/// Cell of a Boolean: an edge if the value changed, then the level.
fn level(earlier: u64, now: u64, cell: usize, pen: &Pen) -> String {
    let level = if now == 1 { pen.high } else { pen.low };
    let edge = match (earlier, now) {
        (0, 1) => pen.rise,
        (1, 0) => pen.fall,
        _ => level,
    };
    std::iter::once(edge).chain(std::iter::repeat_n(level, cell - 1)).collect()
}

/// Cell of a number, printed if it changed.
fn number(text: &str, is_new: bool, cell: usize, pen: &Pen) -> String {
    let mark = if is_new { pen.change } else { ' ' };
    let text: String =
        if text.chars().count() < cell { text.to_owned() } else { text.chars().take(cell - 2).chain(['~']).collect() };
    format!("{mark}{text:<width$}", width = cell - 1)
}
