//! Attributes and labels: the texts of a PNML element, each with where it stands.

use roxmltree::Node;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// A text without outer blanks, and where it stands.
#[derive(Clone, Debug)]
pub struct Text {
    pub text: String,
    pub span: Span,
}

/// The children of an element that have a name in the PNML sense: no text, no comments.
pub fn elements<'a, 'i>(node: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(Node::is_element)
}

/// The start tag's name, without namespace.
pub fn tag<'a>(node: Node<'a, '_>) -> &'a str {
    node.tag_name().name()
}

/// Where an element's start tag begins: from `<` to behind the tag's name.
pub fn tag_span(node: Node<'_, '_>) -> Span {
    let start = node.range().start;
    let name = node.document().input_text()[start..].find([' ', '\t', '\r', '\n', '/', '>']);
    Span::new(start, start + name.unwrap_or(1))
}

/// An attribute.
pub fn attribute(node: Node<'_, '_>, name: &str) -> Option<Text> {
    let attribute = node.attribute_node(name)?;
    let range = attribute.range_value();
    Some(Text { text: attribute.value().trim().to_owned(), span: Span::new(range.start, range.end) })
}

/// An attribute that must be there.
pub fn required(node: Node<'_, '_>, name: &str, diagnostics: &mut Vec<Diagnostic>) -> Option<Text> {
    let attribute = attribute(node, name);
    if attribute.is_none() {
        let message = format!("this `<{}>` has no attribute `{name}`", tag(node));
        diagnostics.push(Diagnostic::new(Code::NetSyntax, tag_span(node), message));
    }
    attribute
}

/// The content of the element `<text>` of a label.
pub fn text(label: Node<'_, '_>) -> Option<Text> {
    let element = elements(label).find(|&child| tag(child) == "text")?;
    let content: String = element.children().filter(Node::is_text).filter_map(|piece| piece.text()).collect();
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
    Some(Text { text: content.trim().to_owned(), span })
}

/// The natural number of a label, without leading zeros.
pub fn number(label: Node<'_, '_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Text> {
    let Some(Text { text, span }) = text(label) else {
        let message = format!("this `<{}>` has no `<text>`", tag(label));
        diagnostics.push(Diagnostic::new(Code::NetSyntax, tag_span(label), message));
        return None;
    };
    if text.is_empty() || !text.bytes().all(|b| b.is_ascii_digit()) {
        let message = format!("`{text}` is no natural number");
        diagnostics.push(Diagnostic::new(Code::NetSyntax, span, message));
        return None;
    }
    let digits = text.trim_start_matches('0');
    Some(Text { text: if digits.is_empty() { "0" } else { digits }.to_owned(), span })
}
