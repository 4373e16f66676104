//! Attributes and labels: the texts of a PNML element, each with where it stands.

use roxmltree::Node;

use crate::diagnostic::{Code, Diagnostic};
use crate::xml::{Text, attribute, content, elements, tag, tag_span};

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
    elements(label).find(|&child| tag(child) == "text").map(content)
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
