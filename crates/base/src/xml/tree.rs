//! XML documents as trees.

use roxmltree::{Document, Node};

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{Source, Span};

/// Text without outer blanks, and its span.
#[derive(Clone, Debug)]
pub struct Text {
    /// The text, with entities resolved.
    pub text: String,
    /// Place in the source.
    pub span: Span,
}

/// Parses a document, or says why the text is not one.
pub fn document<'s>(source: &'s Source, code: Code, format: &str) -> Result<Document<'s>, Diagnostic> {
    Document::parse(source.text()).map_err(|error| malformed(&error, source, code, format))
}

fn malformed(error: &roxmltree::Error, source: &Source, code: Code, format: &str) -> Diagnostic {
    use roxmltree::Error;
    let at = match error {
        // Neither error has a position of its own.
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => source.text().trim_end().len(),
        Error::DtdDetected => source.text().find("<!DOCTYPE").unwrap_or(0),
        _ => offset(source, error.pos()).min(source.text().trim_end().len()),
    };
    if matches!(error, Error::DtdDetected) {
        return super::document_type(at, code, format);
    }
    let text = error.to_string();
    super::ill_formed(at, code, &text.replace(&format!(" at {}", error.pos()), ""))
}

/// The byte offset of a line and column, both counted from 1, the column in characters.
fn offset(source: &Source, position: roxmltree::TextPos) -> usize {
    let line = source.lines(position.row as usize, position.row as usize);
    let text = source.slice(line);
    line.start + text.char_indices().nth(position.col as usize - 1).map_or(text.len(), |(at, _)| at)
}

/// Child elements of an element, without text and comments.
pub fn elements<'a, 'i>(node: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(Node::is_element)
}

/// First child element with a name.
pub fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    elements(node).find(|&child| tag(child) == name)
}

/// Name of the element, without namespace.
pub fn tag<'a>(node: Node<'a, '_>) -> &'a str {
    node.tag_name().name()
}

/// Span of the beginning of the start tag: from `<` to the end of the name.
pub fn tag_span(node: Node<'_, '_>) -> Span {
    let start = node.range().start;
    let name = node.document().input_text()[start..].find([' ', '\t', '\r', '\n', '/', '>']);
    Span::new(start, start + name.unwrap_or(1))
}

/// Value of an attribute, without outer blanks.
pub fn attribute(node: Node<'_, '_>, name: &str) -> Option<Text> {
    let attribute = node.attribute_node(name)?;
    let range = attribute.range_value();
    Some(Text { text: attribute.value().trim().to_owned(), span: Span::new(range.start, range.end) })
}

/// Text content of an element, without comments and child elements; the span of an empty content is that of the tag.
pub fn content(element: Node<'_, '_>) -> Text {
    let text: String = element.children().filter(Node::is_text).filter_map(|piece| piece.text()).collect();
    let written = element.children().find(|piece| piece.is_text() && !piece.text().unwrap_or("").trim().is_empty());
    let span = written.map_or_else(
        || tag_span(element),
        |piece| {
            let range = piece.range();
            let source = &element.document().input_text()[range.clone()];
            let start = range.start + source.len() - source.trim_start().len();
            Span::new(start, start + source.trim().len())
        },
    );
    Text { text: text.trim().to_owned(), span }
}
