//! Data types and declarations of variables.

use roxmltree::Node;

use super::{MAX_DEPTH, Reader};
use crate::syntax::ast::{Declaration, Name, Range, TypeDeclaration, TypeSpec};
use petril_base::diagnostic::Code;
use petril_base::source::Span;
use petril_base::xml::{attribute, child, elements, tag, tag_span};

impl Reader<'_> {
    /// Reads an element `<dataType>`.
    pub fn data_type(&mut self, node: Node<'_, '_>) -> Option<TypeDeclaration> {
        let name = self.declared(node)?;
        Some(TypeDeclaration { name, spec: self.type_in(node, "baseType", 0), initial: self.initial(node) })
    }

    /// Reads an element `<variable>`, of a block or a structure.
    pub fn variable(&mut self, node: Node<'_, '_>, depth: usize) -> Option<Declaration> {
        let name = self.declared(node)?;
        let location = attribute(node, "address").filter(|address| !address.text.is_empty());
        Some(Declaration {
            names: vec![name],
            location: location.map(|address| Name { text: address.text, span: address.span }),
            spec: self.type_in(node, "type", depth),
            edge: None,
            initial: self.initial(node),
        })
    }

    /// Reads the type in an element's child `<type>` or `<baseType>`; `None` has been reported.
    pub fn type_in(&mut self, node: Node<'_, '_>, holder: &str, depth: usize) -> Option<TypeSpec> {
        let Some(inner) = child(node, holder).and_then(|holder| elements(holder).next()) else {
            self.report(Code::XmlSyntax, tag_span(node), format!("this `<{}>` has no `<{holder}>`", tag(node)), "");
            return None;
        };
        self.type_of(inner, depth)
    }

    /// Reads the type that an element like `<INT/>`, `<derived/>` or `<array>` stands for; `None` has been reported.
    pub fn type_of(&mut self, node: Node<'_, '_>, depth: usize) -> Option<TypeSpec> {
        let span = tag_span(node);
        if depth > MAX_DEPTH {
            self.report(Code::Syntax, span, format!("types are nested more than {MAX_DEPTH} deep here"), "");
            return None;
        }
        let named = |text: &str| Some(TypeSpec::Named(Name { text: text.to_owned(), span: word(span) }));
        match tag(node) {
            "derived" => self.required(node, "name").map(TypeSpec::Named),
            "array" => {
                let dimensions = elements(node).filter(|&part| tag(part) == "dimension");
                let ranges: Vec<Range> = dimensions.filter_map(|dimension| self.range(dimension)).collect();
                let of = Box::new(self.type_in(node, "baseType", depth + 1)?);
                if ranges.is_empty() {
                    self.report(Code::XmlSyntax, span, "this `<array>` has no `<dimension>`", "");
                    return None;
                }
                Some(TypeSpec::Array { ranges, of, span })
            }
            "struct" => {
                let members = elements(node).filter(|&part| tag(part) == "variable");
                let members = members.filter_map(|member| self.variable(member, depth + 1)).collect();
                Some(TypeSpec::Structure { members, span })
            }
            "enum" => self.enumeration(node),
            "subrangeSigned" | "subrangeUnsigned" => {
                let base = match self.type_in(node, "baseType", depth + 1)? {
                    TypeSpec::Named(name) => name,
                    other => Name { text: tag(node).to_owned(), span: other.span() },
                };
                let Some(range) = child(node, "range") else {
                    self.report(Code::XmlSyntax, span, format!("this `<{}>` has no `<range>`", tag(node)), "");
                    return None;
                };
                Some(TypeSpec::Subrange { base, range: self.range(range)? })
            }
            // For types that are not modelled the name is enough.
            "string" => named("STRING"),
            "wstring" => named("WSTRING"),
            "pointer" => named("POINTER"),
            elementary => named(elementary),
        }
    }

    fn range(&mut self, node: Node<'_, '_>) -> Option<Range> {
        Some(Range { lower: self.required(node, "lower")?, upper: self.required(node, "upper")? })
    }

    fn enumeration(&mut self, node: Node<'_, '_>) -> Option<TypeSpec> {
        let values = child(node, "values").into_iter().flat_map(elements).filter(|&value| tag(value) == "value");
        let mut names = Vec::new();
        for value in values {
            let name = self.declared(value)?;
            let number = attribute(value, "value").filter(|number| !number.text.is_empty());
            if let Some(number) = number.filter(|number| number.text != names.len().to_string()) {
                let message = format!("`{}` has the number {}", name.text, number.text);
                let help =
                    "values of enumerations are numbered 0, 1, 2, … in their order; other numbers are not supported";
                self.report(Code::DeclarationNotSupported, number.span, message, help);
            }
            names.push(name);
        }
        if names.is_empty() {
            self.report(Code::XmlSyntax, tag_span(node), "this `<enum>` has no values", "");
            return None;
        }
        Some(TypeSpec::Enumeration(names))
    }
}

/// Span of a tag without its `<`.
fn word(tag: Span) -> Span {
    Span::new(tag.start + 1, tag.end)
}
