//! Entry point of the reader: text to properties, with all errors.

use std::collections::HashMap;

use roxmltree::Node;

use super::reader::Reader;
use super::{Place, Property, Query};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::{Source, Span};
use petril_base::xml::{self, Text, elements, tag, tag_span};

const EXAMPLE: &str = "a property is like `<property><id>…</id><formula>…</formula></property>`";

/// Reads all properties that can be read, and reports every error.
///
/// Errors are malformed XML; unknown or misplaced elements; duplicate ids; LTL formulas, and formulas nested more than
/// 500 levels deep.
#[must_use]
pub fn read(source: &Source) -> (Vec<Property>, Vec<Diagnostic>) {
    let document = match xml::document(source, Code::RequirementSyntax, "a property file") {
        Ok(document) => document,
        Err(diagnostic) => return (Vec::new(), vec![diagnostic]),
    };
    let root = document.root_element();
    let mut reader = Reader::default();
    let mut properties = Vec::new();
    if tag(root) != "property-set" {
        let help = "a property file begins with `<property-set>`";
        reader.refuse_with_help(tag_span(root), format!("this is no property file but `<{}>`", tag(root)), help);
        return (properties, reader.diagnostics);
    }
    let mut ids: HashMap<String, Span> = HashMap::new();
    for element in elements(root) {
        if tag(element) != "property" {
            reader.unknown(element, &["property"]);
            continue;
        }
        let Some(property) = property(element, &mut reader) else { continue };
        let first = *ids.entry(property.id.clone()).or_insert(property.span);
        if first != property.span {
            let message = format!("there are two properties with the id `{}`", property.id);
            reader.diagnostics.push(
                Diagnostic::new(Code::RequirementNameTwice, property.span, message)
                    .also(first, "the first is here")
                    .help("give each an id of its own"),
            );
        }
        properties.push(property);
    }
    if properties.is_empty() && reader.diagnostics.is_empty() {
        reader.refuse_with_help(tag_span(root), "this file holds no property", EXAMPLE);
    }
    reader.diagnostics.sort_by_key(Diagnostic::span);
    (properties, reader.diagnostics)
}

fn property(element: Node<'_, '_>, reader: &mut Reader) -> Option<Property> {
    reader.begin();
    let [mut id, mut formula] = [None; 2];
    for child in reader.children(element) {
        let slot = match tag(child) {
            "id" => &mut id,
            "formula" => &mut formula,
            // Descriptions are for people.
            "description" => continue,
            _ => {
                reader.unknown(child, &["id", "description", "formula"]);
                continue;
            }
        };
        if slot.replace(child).is_some() {
            let help = "put each property into a `<property>` of its own";
            reader.refuse_with_help(tag_span(child), format!("this property has a second `<{}>`", tag(child)), help);
        }
    }
    for (slot, name) in [(id, "id"), (formula, "formula")] {
        if slot.is_none() {
            reader.refuse_with_help(tag_span(element), format!("this property has no `<{name}>`"), EXAMPLE);
        }
    }
    let id = id.and_then(|id| reader.text(id));
    let query = formula.and_then(|formula| query(formula, reader));
    let Text { text: id, span } = id?;
    Some(Property { id, span, query: query? })
}

fn query(formula: Node<'_, '_>, reader: &mut Reader) -> Option<Query> {
    let [only] = reader.operands(formula)?;
    if tag(only) != "place-bound" {
        return reader.truth(only, 0).map(Query::Holds);
    }
    let places = reader.names(only, "place")?;
    Some(Query::Bound(places.into_iter().map(|Text { text, span }| Place { id: text, span }).collect()))
}
