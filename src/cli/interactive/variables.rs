//! Variables pane: changed ones are marked, and inputs show the value read next.

use petril::semantics::{Role, VarId};
use ratatui::layout::Rect;
use ratatui::style::Stylize;
use ratatui::text::{Line, Span};

use super::screen::Screen;

/// Title: names of the columns.
pub fn title(screen: &Screen<'_>) -> String {
    if screen.session.is_within() { "variables" } else { "variables → next" }.to_owned()
}

/// Part of the list that fits, around the selected variable.
pub fn lines(screen: &Screen<'_>, area: Rect) -> Vec<Line<'static>> {
    let mut rows = Vec::new();
    for &id in &screen.variables {
        let role = screen.program().variable(id).role;
        if !matches!(rows.last(), Some(&Row::Variable(before)) if screen.program().variable(before).role == role) {
            rows.push(Row::Heading(role));
        }
        rows.push(Row::Variable(id));
    }
    let chosen = screen.variables.get(screen.chosen);
    let at = rows.iter().position(|row| matches!(row, Row::Variable(id) if Some(id) == chosen)).unwrap_or(0);
    let height = usize::from(area.height);
    let first = at.saturating_sub(height / 2).min(rows.len().saturating_sub(height));
    let shown = &rows[first..rows.len().min(first + height)];
    let next = if screen.session.is_within() { Vec::new() } else { screen.session.next_inputs() };
    let length = |row: &Row| match *row {
        Row::Variable(id) => screen.program().variable(id).name.chars().count(),
        Row::Heading(_) => 0,
    };
    let longest = shown.iter().map(length).max().unwrap_or(0);
    let line = |row: &Row| match *row {
        Row::Heading(role) => Line::from(heading(role)).dim(),
        Row::Variable(id) => {
            let next = next.iter().find(|&&(input, _)| input == id).map(|&(_, value)| value);
            let line = line(screen, id, next, longest, area.width.into());
            if chosen == Some(&id) { line.reversed() } else { line }
        }
    };
    shown.iter().map(line).collect()
}

/// Row of the list.
enum Row {
    Heading(Role),
    Variable(VarId),
}

fn heading(role: Role) -> &'static str {
    match role {
        Role::Input => "inputs",
        Role::Output => "outputs",
        Role::Memory => "memory",
        Role::Constant => "constants",
        Role::Buffer => "buffers",
    }
}

/// `3 Level  *80 → 81`: key, name, a star if changed, value, and the value read next if different.
fn line(screen: &Screen<'_>, id: VarId, next: Option<u64>, longest: usize, width: usize) -> Line<'static> {
    let program = screen.program();
    let value = screen.session.value(id);
    let is_changed = screen.session.is_changed(id);
    let text = format!("{}{}", if is_changed { "*" } else { " " }, program.value_text(id, value));
    let next = next.filter(|&next| next != value).map(|next| format!(" → {}", program.value_text(id, next)));
    let next = next.unwrap_or_default();
    let key = screen.label(id).unwrap_or(' ');
    let room = width.saturating_sub(3 + text.chars().count() + next.chars().count()).clamp(1, longest.max(12));
    let name = fitting(&program.variable(id).name, room);
    let name = Span::raw(format!("{key} {name:room$} "));
    let text = if is_changed { text.bold().yellow() } else { Span::raw(text) };
    Line::from_iter([name, text, next.cyan()])
}

/// Fits a name into `room` columns; of a longer one, the end is kept.
pub fn fitting(name: &str, room: usize) -> String {
    let length = name.chars().count();
    if length <= room {
        return name.to_owned();
    }
    let kept = name.chars().skip(length - room.saturating_sub(1));
    std::iter::once('…').chain(kept).collect()
}
