//! Timing diagrams of runs: a line for each variable, a cell for each scan.

use petril::semantics::{Role, VarId};
use petril::translate::System;
use petril::witness::{Scan, ScanTrace};

/// The characters of a diagram.
pub struct Pen {
    low: char,
    high: char,
    rise: char,
    fall: char,
    change: char,
}

/// For every terminal.
pub const ASCII: Pen = Pen { low: '_', high: '"', rise: '/', fall: '\\', change: '|' };
/// For most of them.
pub const UNICODE: Pen = Pen { low: '▁', high: '▔', rise: '╱', fall: '╲', change: '│' };

/// A number is given so many characters at most.
const WIDEST: usize = 10;

/// The diagram of a run: the inputs as the scans read them, memory and outputs as they left them. It is split into pieces no wider
/// than `width`.
pub fn diagram(system: &System, trace: &ScanTrace, width: usize, pen: &Pen) -> String {
    let program = &system.program;
    let scans: Vec<&Scan> = trace.scans.iter().filter(|scan| scan.end.is_some()).collect();
    let groups = [Role::Input, Role::Memory, Role::Output].map(|role| program.with_role(role).collect::<Vec<_>>());
    let shown: Vec<VarId> = groups.iter().flatten().copied().collect();
    let names =
        shown.iter().map(|&id| program.variable(id).name.chars().count()).chain(["scan".len()]).max().unwrap_or(0);
    let value = |scan: &Scan, id: VarId| scan.end.as_ref().map_or(0, |end| end.memory[id.0]);
    let text = |scan: &Scan, id: VarId| program.value_text(id, value(scan, id));
    let widest = shown.iter().filter(|&&id| !program.variable(id).ty.is_bool());
    let widest = widest.flat_map(|&id| scans.iter().map(move |scan| text(scan, id).chars().count())).max().unwrap_or(0);
    let cell = (widest.min(WIDEST) + 1).max(trace.scans.len().to_string().len() + 1).max(4);
    let many = (width.saturating_sub(names + 1) / cell).max(1);
    let mut pieces = Vec::new();
    for (piece, part) in scans.chunks(many).enumerate() {
        let first = piece * many;
        let before = |position: usize| first.checked_add(position)?.checked_sub(1).map(|at| scans[at]);
        let mut lines = vec![format!("{:<names$} {}", "scan", heads(first, part.len(), cell))];
        for group in groups.iter().filter(|group| !group.is_empty()) {
            for &id in group {
                let variable = program.variable(id);
                let mut line = format!("{:<names$} ", variable.name);
                for (position, scan) in part.iter().enumerate() {
                    let earlier = before(position).map_or(variable.initial, |scan| value(scan, id));
                    let now = value(scan, id);
                    line += &if variable.ty.is_bool() {
                        level(earlier, now, cell, pen)
                    } else {
                        let is_new = earlier != now || position == 0;
                        number(&if is_new { text(scan, id) } else { String::new() }, is_new, cell, pen)
                    };
                }
                lines.push(line.trim_end().to_owned());
            }
        }
        pieces.push(lines.join("\n") + "\n");
    }
    pieces.join("\n")
}

/// The numbers of some scans, from 0 on.
fn heads(first: usize, count: usize, cell: usize) -> String {
    let heads = (first + 1..=first + count).map(|scan| format!(" {scan:<width$}", width = cell - 1));
    heads.collect::<String>().trim_end().to_owned()
}

/// A truth value during one scan, after an edge.
fn level(earlier: u64, now: u64, cell: usize, pen: &Pen) -> String {
    let level = if now == 1 { pen.high } else { pen.low };
    let edge = match (earlier, now) {
        (0, 1) => pen.rise,
        (1, 0) => pen.fall,
        _ => level,
    };
    std::iter::once(edge).chain(std::iter::repeat_n(level, cell - 1)).collect()
}

/// A number during one scan, if it is a new one.
fn number(text: &str, is_new: bool, cell: usize, pen: &Pen) -> String {
    let mark = if is_new { pen.change } else { ' ' };
    let text: String =
        if text.chars().count() < cell { text.to_owned() } else { text.chars().take(cell - 2).chain(['~']).collect() };
    format!("{mark}{text:<width$}", width = cell - 1)
}
