//! Initial values: text where they are simple, elements where they have parts.

use roxmltree::Node;

use super::{MAX_DEPTH, Reader};
use crate::syntax::ast::{Initial, InitialKind};
use petril_base::diagnostic::Code;
use petril_base::source::Span;
use petril_base::xml::{attribute, child, elements, tag, tag_span};

impl Reader<'_> {
    /// Reads the initial value of a declaration, by its element.
    pub fn initial(&mut self, declaration: Node<'_, '_>) -> Option<Initial> {
        let holder = child(declaration, "initialValue")?;
        self.value(holder, 0)
    }

    /// Reads the value inside an element.
    fn value(&mut self, holder: Node<'_, '_>, depth: usize) -> Option<Initial> {
        let node = elements(holder).find(|&node| matches!(tag(node), "simpleValue" | "arrayValue" | "structValue"))?;
        let span = tag_span(node);
        if depth > MAX_DEPTH {
            self.report(Code::Syntax, span, format!("values are nested more than {MAX_DEPTH} deep here"), "");
            return None;
        }
        let parts = elements(node).filter(|&part| tag(part) == "value");
        let kind = match tag(node) {
            "arrayValue" => InitialKind::List(parts.filter_map(|part| self.item(part, depth)).collect()),
            "structValue" => {
                let member = |part| Some((self.required(part, "member")?, self.value(part, depth + 1)?));
                let members: Vec<_> = parts.filter_map(member).collect();
                // Without listed members, every member has the initial value of its type.
                if members.is_empty() {
                    return None;
                }
                InitialKind::Structure(members)
            }
            _ => return self.simple(node),
        };
        Some(Initial { kind, span })
    }

    /// Value of an array, with its repetition count.
    fn item(&mut self, part: Node<'_, '_>, depth: usize) -> Option<(u64, Initial)> {
        let times = match attribute(part, "repetitionValue") {
            None => 1,
            Some(times) => match times.text.parse() {
                Ok(number) => number,
                Err(_) => {
                    let message = format!("`{}` is no number of times", times.text);
                    self.report(Code::XmlSyntax, times.span, message, "a value comes a whole number of times");
                    return None;
                }
            },
        };
        let default = Initial { kind: InitialKind::List(Vec::new()), span: tag_span(part) };
        Some((times, self.value(part, depth + 1).unwrap_or(default)))
    }

    fn simple(&mut self, node: Node<'_, '_>) -> Option<Initial> {
        let Span { start, .. } = attribute(node, "value").filter(|value| !value.text.is_empty())?.span;
        let piece = self.pieces.take(start).unwrap_or_default();
        self.diagnostics.extend(piece.diagnostics);
        piece.initial
    }
}
