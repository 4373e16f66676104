//! Elements in elements, names, texts: what all parts of a property file have, and what is wrong with them.

use roxmltree::Node;

use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_base::xml::{Text, content, elements, tag, tag_span};

/// Reads elements, and keeps what is wrong with them.
#[derive(Default)]
pub struct Reader {
    pub diagnostics: Vec<Diagnostic>,
    /// What was said of this property, and is said once only.
    said: Vec<&'static str>,
}

impl Reader {
    /// Begins the next property.
    pub fn begin(&mut self) {
        self.said.clear();
    }

    /// Keeps an error of the format.
    pub fn refuse(&mut self, span: Span, message: impl Into<String>) {
        self.diagnostics.push(Diagnostic::new(Code::RequirementSyntax, span, message));
    }

    /// The same with advice.
    pub fn refuse_with_help(&mut self, span: Span, message: impl Into<String>, help: &str) {
        self.diagnostics.push(Diagnostic::new(Code::RequirementSyntax, span, message).help(help));
    }

    /// Refuses an element that is none of those that can stand here.
    pub fn unknown(&mut self, element: Node<'_, '_>, known: &[&str]) {
        let name = tag(element);
        match known {
            [only] => self.refuse(tag_span(element), format!("expected `<{only}>`, found `<{name}>`")),
            _ => {
                let message = format!("`<{name}>` cannot stand here");
                let diagnostic = Diagnostic::new(Code::RequirementSyntax, tag_span(element), message);
                let position = self.diagnostics.len();
                self.diagnostics.push(diagnostic.suggest_at(position, name, known.iter().copied()));
            }
        }
    }

    /// Whether this was not said of the property yet; then it is now.
    pub fn first(&mut self, message: &'static str) -> bool {
        let first = !self.said.contains(&message);
        if first {
            self.said.push(message);
        }
        first
    }

    /// The elements in an element that holds nothing else.
    pub fn children<'a, 'i>(&mut self, element: Node<'a, 'i>) -> Vec<Node<'a, 'i>> {
        self.attributes(element);
        let Text { text, span } = content(element);
        if !text.is_empty() {
            self.refuse(span, format!("there is text in `<{}>`, which holds elements only", tag(element)));
        }
        elements(element).collect()
    }

    /// The elements in an element that holds just so many.
    pub fn operands<'a, 'i, const N: usize>(&mut self, element: Node<'a, 'i>) -> Option<[Node<'a, 'i>; N]> {
        let children = self.children(element);
        let found = children.len();
        let operands = children.try_into().ok();
        if operands.is_none() {
            let expected = match N {
                0 => "nothing",
                1 => "one element",
                _ => "two elements",
            };
            self.refuse(tag_span(element), format!("`<{}>` holds {expected}, here are {found}", tag(element)));
        }
        operands
    }

    /// The names in an element that holds elements of one kind, at least one.
    pub fn names(&mut self, element: Node<'_, '_>, kind: &str) -> Option<Vec<Text>> {
        let children = self.children(element);
        if children.is_empty() {
            self.refuse(tag_span(element), format!("this `<{}>` holds no `<{kind}>`", tag(element)));
            return None;
        }
        let name = |child: Node<'_, '_>| {
            if tag(child) == kind {
                return self.text(child);
            }
            self.unknown(child, &[kind]);
            None
        };
        let names: Vec<Option<Text>> = children.into_iter().map(name).collect();
        names.into_iter().collect()
    }

    /// The text of an element that holds nothing else.
    pub fn text(&mut self, element: Node<'_, '_>) -> Option<Text> {
        self.attributes(element);
        let text = content(element);
        if let Some(inner) = elements(element).next() {
            self.refuse(tag_span(inner), format!("there is an element in `<{}>`, which holds text only", tag(element)));
        } else if text.text.is_empty() {
            self.refuse(tag_span(element), format!("this `<{}>` is empty", tag(element)));
        } else {
            return Some(text);
        }
        None
    }

    /// Refuses attributes: the format has none.
    fn attributes(&mut self, element: Node<'_, '_>) {
        if let Some(attribute) = element.attributes().next() {
            let range = attribute.range();
            let message = format!("`<{}>` has no attribute `{}`", tag(element), attribute.name());
            self.refuse(Span::new(range.start, range.end), message);
        }
    }
}
