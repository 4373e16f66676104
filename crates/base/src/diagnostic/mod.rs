//! Diagnostics as data: a code, a message, labelled spans, and help that says how to correct it.
//!
//! A label says what is there; help says what to do. Nothing here prints: [`render()`] returns text, and the command
//! line prints it.

mod code;
mod expected;
#[cfg(feature = "render")]
mod render;
mod suggest;

pub use code::{Code, Severity};
pub use expected::{expected, plain_letters};
#[cfg(feature = "render")]
pub use render::{Style, render};
pub use suggest::nearest;

use crate::source::Span;

/// A problem in a source text: an error or a warning, with its places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Code of the problem.
    pub code: Code,
    /// Message: one sentence that says what is wrong with this very text.
    pub message: String,
    /// Places concerned; the first is the primary one, where the reader is sent.
    pub labels: Vec<Label>,
    /// Help: what to do about it, one sentence each.
    pub help: Vec<String>,
}

/// Label: a span with a note on what stands there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// Span concerned.
    pub span: Span,
    /// Note on what is there; may be empty for the first label, where the message says it.
    pub text: String,
}

impl Diagnostic {
    /// Creates a diagnostic with its message and the place it is about.
    pub fn new(code: Code, span: Span, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), labels: vec![Label { span, text: String::new() }], help: Vec::new() }
    }

    /// Sets the note of the primary label.
    #[must_use]
    pub fn here(mut self, text: impl Into<String>) -> Self {
        self.labels[0].text = text.into();
        self
    }

    /// Adds a secondary label.
    #[must_use]
    pub fn also(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into() });
        self
    }

    /// Adds a sentence of help.
    #[must_use]
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help.push(text.into());
        self
    }

    /// Adds "did you mean …?" if one of the candidates is close to what was written.
    #[must_use]
    pub fn suggest<'a>(self, written: &str, candidates: impl IntoIterator<Item = &'a str>) -> Self {
        match nearest(written, candidates) {
            Some(name) => self.help(format!("did you mean `{name}`?")),
            None => self,
        }
    }

    /// Adds a suggestion as [`suggest`](Self::suggest) does, but only to the first 100 problems of a list (`position`
    /// counts from 0): nobody reads the hundred-and-first, and to suggest a name for each of thousands takes minutes.
    #[must_use]
    pub fn suggest_at<'a>(self, position: usize, written: &str, candidates: impl IntoIterator<Item = &'a str>) -> Self {
        if position < 100 { self.suggest(written, candidates) } else { self }
    }

    /// Span of the primary label, where the reader is sent.
    #[must_use]
    pub fn span(&self) -> Span {
        self.labels[0].span
    }

    /// Whether the problem is an error: the text cannot be used.
    #[must_use]
    pub fn is_error(&self) -> bool {
        self.code.severity() == Severity::Error
    }
}

/// Whether any of the diagnostics is an error.
#[must_use]
pub fn any_error(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(Diagnostic::is_error)
}
