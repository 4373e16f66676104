//! Diagnostics as text: the source excerpt with its labels, in the manner of rustc.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::{Diagnostic, Severity};
use crate::source::Source;

/// Lines of context around an excerpt.
const CONTEXT: usize = 1;

/// How diagnostics are set: with or without colour, and how wide.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// ANSI colours.
    pub colour: bool,
    /// Columns of the terminal.
    pub width: usize,
}

impl Default for Style {
    fn default() -> Self {
        Self { colour: false, width: 120 }
    }
}

/// The diagnostic as lines of text, with code, file, line, column, excerpt and help; ends with a newline.
#[must_use]
pub fn render(diagnostic: &Diagnostic, source: &Source, style: Style) -> String {
    let level = match diagnostic.code.severity() {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let group = level.primary_title(diagnostic.message.as_str()).id(diagnostic.code.id());
    let group = group.element(excerpt(diagnostic, source));
    let group: Group<'_> = group.elements(diagnostic.help.iter().map(|help| Level::HELP.message(help.as_str())));
    let renderer = if style.colour { Renderer::styled() } else { Renderer::plain() };
    let mut text = renderer.term_width(style.width).render(&[group]);
    text.push('\n');
    text
}

/// Only the lines the labels touch go to the renderer: it reads all it is given.
fn excerpt<'a>(diagnostic: &'a Diagnostic, source: &'a Source) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
    let clamp = |offset: usize| offset.min(source.text().len());
    let lines = diagnostic.labels.iter().flat_map(|l| [l.span.start, l.span.end]).map(|o| source.line_of(clamp(o)));
    let first = lines.clone().min().unwrap_or(1).saturating_sub(CONTEXT).max(1);
    let window = source.lines(first, lines.max().unwrap_or(1) + CONTEXT);
    let annotations = diagnostic.labels.iter().enumerate().map(|(i, label)| {
        let kind = if i == 0 { AnnotationKind::Primary } else { AnnotationKind::Context };
        let start = clamp(label.span.start) - window.start;
        let end = (clamp(label.span.end) - window.start).max(start);
        kind.span(start..end).label((!label.text.is_empty()).then_some(label.text.as_str()))
    });
    Snippet::source(source.slice(window)).path(source.name()).line_start(first).annotations(annotations)
}
