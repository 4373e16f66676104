//! Source pane, with the line to be executed next marked.

use ratatui::layout::Rect;
use ratatui::style::Stylize;
use ratatui::text::Line;

use super::screen::Screen;

/// Title: the instruction of flat code to be executed next.
pub fn title(screen: &Screen<'_>) -> String {
    let program = screen.program();
    match screen.session.line().and_then(|line| Some((line, program.code.get(line)?))) {
        Some((line, code)) => format!("source · {}: {}", line + 1, program.text(code.instruction)),
        None => "source".to_owned(),
    }
}

/// Source lines around that of the instruction, or around the first one.
pub fn lines(screen: &Screen<'_>, area: Rect) -> Vec<Line<'static>> {
    let (program, source) = (screen.program(), screen.source);
    let at = |line: usize| program.code.get(line).map(|code| source.line_of(code.span.start));
    let current = screen.session.line().and_then(at);
    let middle = current.or_else(|| screen.session.line().and(program.code.len().checked_sub(1)).and_then(at));
    let middle = middle.or_else(|| at(0)).unwrap_or(1);
    let count = source.line_of(source.text().trim_end().len());
    let height = usize::from(area.height);
    // Centred, but not beyond the ends.
    let first = middle.saturating_sub(height / 2).min((count + 1).saturating_sub(height)).max(1);
    let digits = count.to_string().len();
    (first..=count)
        .take(height)
        .map(|line| {
            let is_current = current == Some(line);
            let mark = if is_current { '▶' } else { ' ' };
            let text = source.slice(source.lines(line, line)).trim_end().replace('\t', "    ");
            let text = Line::from(format!("{mark}{line:digits$} {text}"));
            if is_current { text.bold().yellow() } else { text }
        })
        .collect()
}
