//! Layout of the panes.

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Color, Style, Stylize};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Paragraph};

use petril::flat::value_text;
use petril::printable::is_printable;

use super::screen::{Mode, Screen};
use super::{diagram, overlay, source_pane, tokens, variables};

/// Width from which source and variables are side by side.
const WIDE: u16 = 64;

/// Height below which there is no timing diagram.
const HIGH: u16 = 18;

/// Draws the screen.
pub fn draw(frame: &mut Frame<'_>, screen: &Screen<'_>) {
    let [head, body, foot] =
        Layout::vertical([Constraint::Length(1), Constraint::Fill(1), Constraint::Length(1)]).areas(frame.area());
    frame.render_widget(Paragraph::new(status(screen)).reversed(), head);
    frame.render_widget(Paragraph::new(footer(screen, foot.width.into())), foot);
    let (upper, lower) = if frame.area().height >= HIGH {
        let share = if screen.shows_tokens { Constraint::Percentage(50) } else { Constraint::Percentage(35) };
        let [upper, lower] = Layout::vertical([Constraint::Fill(1), share]).areas(body);
        (upper, Some(lower))
    } else {
        (body, None)
    };
    let halves = [Constraint::Fill(1), Constraint::Fill(1)];
    let [first, second] = if body.width >= WIDE {
        Layout::horizontal(halves).areas(upper)
    } else {
        Layout::vertical(halves).areas(upper)
    };
    // In little space, the tokens replace the source.
    if screen.shows_tokens && lower.is_none() {
        pane(frame, first, "net".to_owned(), |area| tokens::lines(screen, area));
    } else {
        pane(frame, first, source_pane::title(screen), |area| source_pane::lines(screen, area));
    }
    pane(frame, second, variables::title(screen), |area| variables::lines(screen, area));
    if let Some(lower) = lower {
        if screen.shows_tokens {
            pane(frame, lower, tokens::title(screen), |area| tokens::lines(screen, area));
        } else {
            pane(frame, lower, "scans".to_owned(), |area| diagram::lines(screen, area));
        }
    }
    match &screen.mode {
        Mode::Help => overlay::help(frame),
        Mode::Plant(chosen) => overlay::plant(frame, screen, *chosen),
        _ => {}
    }
    hide_unprintable(frame);
}

/// Replaces characters that could hide or reorder what is beside them.
fn hide_unprintable(frame: &mut Frame<'_>) {
    let cells = frame.buffer_mut().content.iter_mut();
    for cell in cells.filter(|cell| !cell.symbol().chars().all(is_printable)) {
        cell.set_symbol("\u{FFFD}");
    }
}

/// Draws lines in a frame with a title.
fn pane(frame: &mut Frame<'_>, area: Rect, title: String, lines: impl FnOnce(Rect) -> Vec<Line<'static>>) {
    let block = Block::bordered().border_style(Style::new().dark_gray()).title(title.bold());
    let inner = block.inner(area);
    frame.render_widget(block, area);
    frame.render_widget(Paragraph::new(lines(inner)), inner);
}

/// Status line: the current position of the run.
fn status(screen: &Screen<'_>) -> String {
    let session = &screen.session;
    let (done, planned) = (session.scans().len(), session.planned());
    let (mut text, begun) = match (session.is_within(), done) {
        (true, _) => (format!(" in scan {}", done + 1), 1),
        (false, 0) => (" power-on".to_owned(), 0),
        (false, _) => (format!(" after scan {done}"), 0),
    };
    if planned > done + begun {
        text += &format!(", {} to come", planned - done - begun);
    }
    match session.line() {
        Some(line) if line == screen.program().end() => text += " · at the end",
        Some(line) => text += &format!(" · line {}", line + 1),
        None if session.is_within() => text += " · before the program",
        None => {}
    }
    if let Some((ty, result)) = session.result() {
        text += &format!(" · CR {}", value_text(ty, result));
    }
    text + &format!(" · {}", screen.source.name())
}

/// Bottom line: a message, a question, or the most important keys.
fn footer(screen: &Screen<'_>, width: usize) -> Line<'static> {
    let ask = |question: String, text: &str| {
        let problem = screen.message.as_ref().map(|(problem, _)| format!("  {problem}").fg(Color::Red));
        Line::from_iter([question.bold(), Span::raw(text.to_owned()), Span::raw("_")].into_iter().chain(problem))
    };
    match (&screen.mode, &screen.message) {
        (Mode::Until(text), _) => ask("run until: ".to_owned(), text),
        (Mode::Value(input, text), _) => ask(format!("{} := ", screen.program().variable(*input).name), text),
        (_, Some((message, true))) => Line::from(message.clone().fg(Color::Red)),
        (_, Some((message, false))) => Line::from(message.clone().fg(Color::Green)),
        (_, None) => match screen.note() {
            Some(note) => Line::from(note.fg(Color::Cyan)),
            None => Line::from(hints(width)).dim(),
        },
    }
}

/// As many of the most important keys as fit.
fn hints(width: usize) -> String {
    let hints = ["s scan", "l line", "t transition", "S L T back", "/ until", "r random", "n net", "p plant"];
    let mut text = "? help  q quit".to_owned();
    for hint in hints {
        if text.chars().count() + hint.len() + 4 <= width {
            text += &format!("  {hint}");
        }
    }
    text
}
