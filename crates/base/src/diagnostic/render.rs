//! Diagnostics as text: the source excerpt with its labels, in the manner of rustc.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::{Diagnostic, Severity};
use crate::printable;
use crate::source::Source;

/// Lines of context around an excerpt.
const CONTEXT: usize = 1;

/// Layout of diagnostics: with or without colour, and how wide.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// Whether ANSI colours are used.
    pub colour: bool,
    /// Width in columns.
    pub width: usize,
}

impl Default for Style {
    fn default() -> Self {
        Self { colour: false, width: 120 }
    }
}

/// Longest line, in bytes, on which more than the first label is shown.
const MAX_LINE: usize = 1000;

/// Longest word of a message, like a quoted name, in characters; longer ones are cut.
const MAX_WORD: usize = 80;

/// Renders a diagnostic as lines of text, with code, file, line, column, excerpt and help; ends with a newline.
#[must_use]
pub fn render(diagnostic: &Diagnostic, source: &Source, style: Style) -> String {
    let level = match diagnostic.code.severity() {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let group = level.primary_title(shortened(&diagnostic.message)).id(diagnostic.code.id());
    let (name, labels) = (
        printable::line(source.name()),
        diagnostic.labels.iter().map(|l| printable::line(&l.text)).collect::<Vec<_>>(),
    );
    let group = group.element(excerpt(diagnostic, source, &name, &labels));
    let group: Group<'_> = group.elements(diagnostic.help.iter().map(|help| Level::HELP.message(shortened(help))));
    let renderer = if style.colour { Renderer::styled() } else { Renderer::plain() };
    let mut text = renderer.term_width(style.width).render(&[group]);
    text.push('\n');
    text
}

/// Message on one line, with its longest words cut: a name can be as long as a file.
fn shortened(message: &str) -> String {
    let message = printable::line(message);
    let mut length = 0;
    let keep = |c: char| {
        length = if c.is_whitespace() { 0 } else { length + 1 };
        match length {
            _ if c == '`' => Some(c),
            0..=MAX_WORD => Some(c),
            _ if length == MAX_WORD + 1 => Some('…'),
            _ => None,
        }
    };
    message.chars().filter_map(keep).collect()
}

/// Text with a sign of the same length in bytes in place of each character that is not printable, so that offsets stay
/// right. The renderer has signs of its own for the control characters of one byte.
fn visible(text: &str) -> String {
    let sign = |c: char| match c.len_utf8() {
        _ if printable::is_printable(c) => c,
        1 => c,
        2 => '·',
        3 => char::REPLACEMENT_CHARACTER,
        _ => '\u{1F5C6}',
    };
    text.chars().map(sign).collect()
}

/// Excerpt of the source with the labels. Only the lines that labels touch go to the renderer, which reads all of its
/// input.
fn excerpt<'a>(
    diagnostic: &'a Diagnostic,
    source: &'a Source,
    name: &'a str,
    texts: &'a [String],
) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
    let clamp = |offset: usize| offset.min(source.text().len());
    let lines = diagnostic.labels.iter().flat_map(|l| [l.span.start, l.span.end]).map(|o| source.line_of(clamp(o)));
    let first = lines.clone().min().unwrap_or(1).saturating_sub(CONTEXT).max(1);
    let window = source.lines(first, lines.max().unwrap_or(1) + CONTEXT);
    // The renderer prints everything between labels on one line, however far apart they are.
    let mut starts = diagnostic.labels.iter().map(|label| source.line_of(clamp(label.span.start)));
    let is_long = starts.any(|line| source.line_text(line).len() > MAX_LINE);
    let labels = if is_long { 1 } else { diagnostic.labels.len() };
    let annotations = diagnostic.labels.iter().take(labels).enumerate().map(|(i, label)| {
        let kind = if i == 0 { AnnotationKind::Primary } else { AnnotationKind::Context };
        let start = clamp(label.span.start) - window.start;
        let end = (clamp(label.span.end) - window.start).max(start);
        kind.span(start..end).label(Some(texts[i].as_str()).filter(|text| !text.is_empty()))
    });
    Snippet::source(visible(source.slice(window))).path(name).line_start(first).annotations(annotations)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_are_cut() {
        assert_eq!(shortened("`a` is not declared"), "`a` is not declared");
        let long = format!("`{}` and `{}`", "x".repeat(79), "y".repeat(1000));
        assert_eq!(shortened(&long), format!("`{}` and `{}…`", "x".repeat(79), "y".repeat(79)));
    }
}
