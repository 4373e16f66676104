//! XML documents with positions: as a tree, for small documents that are looked at from all sides, or as a stream, for
//! documents that may have hundreds of megabytes.

mod attributes;
mod stream;
mod tree;
mod written;

pub use stream::{Element, Event, Piece, Stream, attribute_at};
pub use tree::{Text, attribute, child, content, document, elements, tag, tag_span};
pub use written::written;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// Refuses a document type declaration, which could define entities of any size: no format that is read has one.
fn document_type(at: usize, code: Code, format: &str) -> Diagnostic {
    let span = Span::new(at, at + "<!DOCTYPE".len());
    Diagnostic::new(code, span, format!("a document type declaration is not part of {format}"))
        .help("remove the `<!DOCTYPE …>` with all its entities")
}

/// Diagnostic for a document that is not well-formed.
fn ill_formed(at: usize, code: Code, what: &str) -> Diagnostic {
    Diagnostic::new(code, Span::new(at, at), format!("this is no well-formed XML: {what}"))
}
