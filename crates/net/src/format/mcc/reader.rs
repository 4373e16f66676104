//! Elements, names and texts of a property file, with their errors.

use roxmltree::Node;

use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_base::xml::{Text, content, elements, tag, tag_span};

/// Reader of elements that collects diagnostics.
#[derive(Default)]
pub struct Reader {
    pub diagnostics: Vec<Diagnostic>,
    /// Messages already reported for this property; each is reported once.
    said: Vec<&'static str>,
}

impl Reader {
    /// Begins the next property.
    pub fn begin(&mut self) {
        self.said.clear();
    }

    /// Reports a format error.
    pub fn refuse(&mut self, span: Span, message: impl Into<String>) {
        self.diagnostics.push(Diagnostic::new(Code::RequirementSyntax, span, message));
    }

    /// Reports a format error with advice.
    pub fn refuse_with_help(&mut self, span: Span, message: impl Into<String>, help: &str) {
        self.diagnostics.push(Diagnostic::new(Code::RequirementSyntax, span, message).help(help));
    }

    /// Rejects an element that is not among those allowed here.
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

    /// Whether a message is new for this property; remembers it.
    pub fn first(&mut self, message: &'static str) -> bool {
        let first = !self.said.contains(&message);
        if first {
            self.said.push(message);
        }
        first
    }

    /// Child elements of an element that contains nothing else.
    pub fn children<'a, 'i>(&mut self, element: Node<'a, 'i>) -> Vec<Node<'a, 'i>> {
        self.attributes(element);
        let Text { text, span } = content(element);
        if !text.is_empty() {
            self.refuse(span, format!("there is text in `<{}>`, which holds elements only", tag(element)));
        }
        elements(element).collect()
    }

    /// Child elements of an element that must contain exactly `N`.
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

    /// Names in an element that contains at least one element, all of one kind.
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

    /// Text of an element that contains nothing else.
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

    /// Rejects attributes: the format has none.
    fn attributes(&mut self, element: Node<'_, '_>) {
        if let Some(attribute) = element.attributes().next() {
            let range = attribute.range();
            let message = format!("`<{}>` has no attribute `{}`", tag(element), attribute.name());
            self.refuse(Span::new(range.start, range.end), message);
        }
    }
}
