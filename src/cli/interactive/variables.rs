//! The variables, those that have changed marked, inputs with what is read next.

use petril::semantics::{Role, VarId};
use ratatui::layout::Rect;
use ratatui::style::Stylize;
use ratatui::text::{Line, Span};

use super::screen::Screen;

/// The names of the columns.
pub fn title(screen: &Screen<'_>) -> String {
    if screen.session.is_within() { "variables" } else { "variables → next" }.to_owned()
}

/// The list, as much of it as there is room for, around the chosen one.
pub fn lines(screen: &Screen<'_>, area: Rect) -> Vec<Line<'static>> {
    let mut lines = Vec::new();
    let mut chosen = 0;
    let mut last = None;
    let next = if screen.session.is_within() { Vec::new() } else { screen.session.next_inputs() };
    for (position, &id) in screen.variables.iter().enumerate() {
        let role = screen.program().variable(id).role;
        if last.replace(role) != Some(role) {
            lines.push(Line::from(heading(role)).dim());
        }
        if position == screen.chosen {
            chosen = lines.len();
        }
        let next = next.iter().find(|&&(input, _)| input == id).map(|&(_, value)| value);
        lines.push(line(screen, id, next, position == screen.chosen, area.width.into()));
    }
    let height = usize::from(area.height);
    let first = chosen.saturating_sub(height / 2).min(lines.len().saturating_sub(height));
    lines.split_off(first)
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

/// `3 Level  *80 → 81`: key, name, a star if it has changed, value, and what is read next if that is another value.
fn line(screen: &Screen<'_>, id: VarId, next: Option<u64>, is_chosen: bool, width: usize) -> Line<'static> {
    let program = screen.program();
    let value = screen.session.value(id);
    let is_changed = screen.session.is_changed(id);
    let text = format!("{}{}", if is_changed { "*" } else { " " }, program.value_text(id, value));
    let next = next.filter(|&next| next != value).map(|next| format!(" → {}", program.value_text(id, next)));
    let next = next.unwrap_or_default();
    let key = screen.label(id).unwrap_or(' ');
    let longest = screen.variables.iter().map(|&id| program.variable(id).name.chars().count()).max().unwrap_or(1);
    let room = width.saturating_sub(3 + text.chars().count() + next.chars().count()).clamp(1, longest.max(12));
    let name = fitting(&program.variable(id).name, room);
    let name = Span::raw(format!("{key} {name:room$} "));
    let text = if is_changed { text.bold().yellow() } else { Span::raw(text) };
    let line = Line::from_iter([name, text, next.cyan()]);
    if is_chosen { line.reversed() } else { line }
}

/// A name in so many columns; of a longer one, its end.
pub fn fitting(name: &str, room: usize) -> String {
    let length = name.chars().count();
    if length <= room {
        return name.to_owned();
    }
    let kept = name.chars().skip(length - room.saturating_sub(1));
    std::iter::once('…').chain(kept).collect()
}
