//! Timing diagram of the last scans.

use petril::semantics::{Role, VarId};
use ratatui::layout::Rect;
use ratatui::style::Stylize;
use ratatui::text::Line;

use super::screen::Screen;
use super::variables::fitting;

/// Cell widths in columns: for Booleans only, and the maximum for numbers.
const NARROW: usize = 2;
const WIDEST: usize = 9;

/// Rows for as many variables as fit, around the selected one: Booleans as a low or high line, numbers where they
/// change.
pub fn lines(screen: &Screen<'_>, area: Rect) -> Vec<Line<'static>> {
    let program = screen.program();
    let scans = screen.session.scans();
    let rows = usize::from(area.height).saturating_sub(1);
    let listed: Vec<VarId> =
        (screen.variables.iter().copied()).filter(|&id| program.variable(id).role != Role::Constant).collect();
    let first = screen.chosen.saturating_sub(rows / 2).min(listed.len().saturating_sub(rows));
    let shown = &listed[first..listed.len().min(first + rows)];
    let names = shown.iter().map(|&id| program.variable(id).name.chars().count()).max().unwrap_or(0).clamp(4, 16);
    let value = |scan: usize, id: VarId| match scan.checked_sub(1) {
        None => program.variable(id).initial,
        Some(scan) => scans[scan].end.as_ref().map_or(0, |end| end.memory[id.0]),
    };
    let numbers = shown.iter().copied().filter(|&id| !program.variable(id).ty.is_bool());
    let recent = scans.len().saturating_sub(area.width.into())..=scans.len();
    let widest = numbers.flat_map(|id| recent.clone().map(move |scan| (id, scan)));
    let widest = widest.map(|(id, scan)| program.value_text(id, value(scan, id)).chars().count() + 1).max();
    let cell = widest.map_or(NARROW, |widest| widest.clamp(NARROW, WIDEST));
    let cells = usize::from(area.width).saturating_sub(names + 1) / cell;
    // Power-on is scan 0.
    let from = (scans.len() + 1).saturating_sub(cells);
    let columns = from..=scans.len();
    // A number may extend over the cells of scans without one.
    let digits = scans.len().to_string().len();
    let every = [1, 5, 10].into_iter().find(|every| every * cell > digits + 1).unwrap_or(50);
    let numbered = columns.clone().filter(|scan| scan % every == 0);
    let ruler = numbered.fold(String::new(), |ruler, scan| format!("{ruler:0$}{scan}", (scan - from) * cell));
    let head = Line::from(format!("{:names$} {ruler}", "scan")).dim();
    let rows = shown.iter().map(|&id| {
        let line = columns.clone().map(|scan| {
            let now = value(scan, id);
            let changes = scan == from || value(scan - 1, id) != now;
            match (program.variable(id).ty.is_bool(), now) {
                (true, 0) => "▁".repeat(cell),
                (true, _) => "▔".repeat(cell),
                (false, _) if changes => fit(&program.value_text(id, now), cell),
                (false, _) => "·".repeat(cell),
            }
        });
        let line: String = line.collect();
        let name = fitting(&program.variable(id).name, names);
        let line = Line::from(format!("{name:names$} {line}"));
        if screen.variables.get(screen.chosen) == Some(&id) { line.bold() } else { line }
    });
    std::iter::once(head).chain(rows).collect()
}

/// Fits a text into a cell, truncated if necessary.
fn fit(text: &str, cell: usize) -> String {
    let text: String = text.chars().take(cell).collect();
    format!("{text:cell$}")
}
