//! XML documents with positions: as a tree, where what is read is small and looked at from all sides, or as a stream, where
//! it may be hundreds of megabytes.

mod attributes;
mod stream;
mod tree;
mod written;

pub use stream::{Element, Event, Piece, Stream, attribute_at};
pub use tree::{Text, attribute, child, content, document, elements, tag, tag_span};
pub use written::written;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// Document type declarations, which could define entities of any size, are refused: no format that is read has them.
fn document_type(at: usize, code: Code, format: &str) -> Diagnostic {
    let span = Span::new(at, at + "<!DOCTYPE".len());
    Diagnostic::new(code, span, format!("a document type declaration is not part of {format}"))
        .help("remove the `<!DOCTYPE …>` with all its entities")
}

/// What every XML reader refuses.
fn ill_formed(at: usize, code: Code, what: &str) -> Diagnostic {
    Diagnostic::new(code, Span::new(at, at), format!("this is no well-formed XML: {what}"))
}
