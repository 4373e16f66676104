//! Domains of inputs as they are written: `level: 0..100`, `k: 0, 3, 7`.

use petril_base::source::Span;

/// A line about the values of an input, before its name means anything.
#[derive(Clone, Debug)]
pub struct DomainText {
    /// The input.
    pub name: String,
    /// Where its name stands.
    pub span: Span,
    /// The numbers from one to another, both included, each with its place.
    pub ranges: Vec<(i128, i128, Span)>,
}
