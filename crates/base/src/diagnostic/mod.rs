//! Diagnostics as data: a code, a message, labelled spans, and help that says how to mend it.
//!
//! A label says what is there; help says what to do. Nothing here prints: [`render()`] gives text, and whoever holds the
//! terminal prints it.

mod code;
mod expected;
mod render;
mod suggest;

pub use code::{Code, Severity};
pub use expected::{expected, plain_letters};
pub use render::{Style, render};
pub use suggest::nearest;

use crate::source::Span;

/// One thing that is wrong (or doubtful) in a source text, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Which of the known problems this is.
    pub code: Code,
    /// One sentence that says what is wrong with this very text.
    pub message: String,
    /// The places concerned; the first is where the reader is sent.
    pub labels: Vec<Label>,
    /// What to do about it, one sentence each.
    pub help: Vec<String>,
}

/// A span and what stands there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The text concerned.
    pub span: Span,
    /// What is there; may be empty for the first label, where the message says it.
    pub text: String,
}

impl Diagnostic {
    /// A diagnostic with its message and the place it is about.
    pub fn new(code: Code, span: Span, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), labels: vec![Label { span, text: String::new() }], help: Vec::new() }
    }

    /// Says what stands at the main place.
    #[must_use]
    pub fn here(mut self, text: impl Into<String>) -> Self {
        self.labels[0].text = text.into();
        self
    }

    /// Adds another place that plays a part.
    #[must_use]
    pub fn also(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into() });
        self
    }

    /// Adds a sentence that says what to do.
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

    /// The same for the problem at this position of a list, from 0: nobody reads the hundred-and-first, and to suggest a
    /// name for each of thousands takes minutes.
    #[must_use]
    pub fn suggest_at<'a>(self, position: usize, written: &str, candidates: impl IntoIterator<Item = &'a str>) -> Self {
        if position < 100 { self.suggest(written, candidates) } else { self }
    }

    /// The place the reader is sent to.
    #[must_use]
    pub fn span(&self) -> Span {
        self.labels[0].span
    }

    /// Whether this makes the text unusable.
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
