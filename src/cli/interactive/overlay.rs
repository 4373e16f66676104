//! Overlays: help, and plant moves.

use ratatui::Frame;
use ratatui::layout::{Constraint, Flex, Layout, Rect};
use ratatui::style::Stylize;
use ratatui::text::Line;
use ratatui::widgets::{Block, Clear, Paragraph};

use super::keys::HELP;
use super::screen::Screen;

/// Help on the keys.
pub fn help(frame: &mut Frame<'_>) {
    let lines = HELP.iter().map(|(key, text)| Line::from_iter([format!("{key:10} ").bold(), (*text).into()]));
    show(frame, "keys", lines.collect());
}

/// Plant moves planned before the next scan, and those possible after them.
pub fn plant(frame: &mut Frame<'_>, screen: &Screen<'_>, chosen: usize) {
    let system = screen.session.system();
    let planned = screen.session.plan().moves.into_iter();
    let mut lines: Vec<Line<'static>> =
        planned.map(|chosen| Line::from(format!("✓ {}", chosen.name(system))).green()).collect();
    for (position, choice) in screen.session.choices().into_iter().enumerate() {
        let line = Line::from(format!("{} {}", position + 1, choice.name(system)));
        lines.push(if position == chosen { line.reversed() } else { line });
    }
    lines.push(Line::from("Enter does it, Backspace takes back, s scans, Esc closes").dim());
    show(frame, "plant, before the next scan", lines);
}

/// Draws lines in a centred box, as far as there is room.
fn show(frame: &mut Frame<'_>, title: &'static str, lines: Vec<Line<'static>>) {
    let width = lines.iter().map(Line::width).max().unwrap_or(0).max(title.len()) + 2;
    let area = middle(frame.area(), width as u16, lines.len() as u16 + 2);
    frame.render_widget(Clear, area);
    frame.render_widget(Paragraph::new(lines).block(Block::bordered().title(title.bold())), area);
}

fn middle(area: Rect, width: u16, height: u16) -> Rect {
    let [area] = Layout::horizontal([Constraint::Length(width)]).flex(Flex::Center).areas(area);
    let [area] = Layout::vertical([Constraint::Length(height)]).flex(Flex::Center).areas(area);
    area
}
