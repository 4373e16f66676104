//! What the pages of a net hold: nodes and arcs by id, before anything is known about whom they refer to.

use roxmltree::Node;

use super::label::{number, required, text};
use crate::diagnostic::{Code, Diagnostic};
use crate::xml::{Text, attribute, elements, tag, tag_span};

/// Places or transitions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Place,
    Transition,
}

/// A node of the net graph, or another name for one.
#[derive(Debug)]
pub struct Item {
    pub id: Text,
    pub name: Option<Text>,
    pub kind: Kind,
    pub marked: bool,
    /// The node a reference node stands for.
    pub stands_for: Option<Text>,
}

#[derive(Debug)]
pub struct Arc {
    pub source: Text,
    pub target: Text,
}

/// Everything on all pages of a net, page by page.
#[derive(Debug, Default)]
pub struct Contents {
    pub items: Vec<Item>,
    pub arcs: Vec<Arc>,
    /// Ids of the elements nobody refers to: the net itself, pages, arcs.
    pub other_ids: Vec<Text>,
}

impl Contents {
    /// Goes through a net. Pages wait in a list for their turn, so that nesting costs no recursion.
    pub fn of(net: Node<'_, '_>, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let mut contents = Self::default();
        let mut pages = vec![net];
        let mut next = 0;
        while let Some(&page) = pages.get(next) {
            next += 1;
            contents.other_ids.extend(attribute(page, "id"));
            for element in elements(page) {
                match tag(element) {
                    "page" => pages.push(element),
                    "place" => contents.item(element, Kind::Place, false, diagnostics),
                    "transition" => contents.item(element, Kind::Transition, false, diagnostics),
                    "referencePlace" => contents.item(element, Kind::Place, true, diagnostics),
                    "referenceTransition" => contents.item(element, Kind::Transition, true, diagnostics),
                    "arc" => contents.arc(element, diagnostics),
                    "name" | "graphics" | "toolspecific" => {}
                    _ => foreign(element, page, diagnostics),
                }
            }
        }
        contents
    }

    fn item(&mut self, element: Node<'_, '_>, kind: Kind, is_reference: bool, diagnostics: &mut Vec<Diagnostic>) {
        let id = required(element, "id", diagnostics);
        let stands_for = if is_reference { required(element, "ref", diagnostics) } else { None };
        let mut name = None;
        let mut marked = false;
        for label in elements(element) {
            match tag(label) {
                "name" => name = text(label).filter(|name| !name.text.is_empty()),
                "graphics" | "toolspecific" => {}
                "initialMarking" if kind == Kind::Place && !is_reference => {
                    marked = marking(label, name.as_ref().or(id.as_ref()), diagnostics);
                }
                _ => foreign(label, element, diagnostics),
            }
        }
        if let Some(id) = id
            && is_reference == stands_for.is_some()
        {
            self.items.push(Item { id, name, kind, marked, stands_for });
        }
    }

    fn arc(&mut self, element: Node<'_, '_>, diagnostics: &mut Vec<Diagnostic>) {
        self.other_ids.extend(attribute(element, "id"));
        let ends = ["source", "target"].map(|end| required(element, end, diagnostics));
        for label in elements(element) {
            match tag(label) {
                "name" | "graphics" | "toolspecific" => {}
                "inscription" => inscription(label, diagnostics),
                _ => foreign(label, element, diagnostics),
            }
        }
        if let [Some(source), Some(target)] = ends {
            self.arcs.push(Arc { source, target });
        }
    }
}

fn marking(label: Node<'_, '_>, place: Option<&Text>, diagnostics: &mut Vec<Diagnostic>) -> bool {
    let Some(tokens) = number(label, diagnostics) else { return false };
    if !matches!(tokens.text.as_str(), "0" | "1") {
        let place = place.map_or("", |place| &place.text);
        let message = format!("the place `{place}` has {} tokens at the beginning", tokens.text);
        let help = "a place of a safe net holds one token at most";
        diagnostics.push(Diagnostic::new(Code::NetNotOrdinary, tokens.span, message).help(help));
    }
    tokens.text == "1"
}

fn inscription(label: Node<'_, '_>, diagnostics: &mut Vec<Diagnostic>) {
    let Some(weight) = number(label, diagnostics) else { return };
    if weight.text != "1" {
        let message = format!("this arc has weight {}", weight.text);
        let help = "in a safe net every arc has weight 1";
        diagnostics.push(Diagnostic::new(Code::NetNotOrdinary, weight.span, message).help(help));
    }
}

/// Refuses what other net types and other tools add, like inhibitor arcs: it could mean anything.
fn foreign(element: Node<'_, '_>, parent: Node<'_, '_>, diagnostics: &mut Vec<Diagnostic>) {
    let message = format!("`<{}>` in `<{}>` is not part of place/transition nets", tag(element), tag(parent));
    diagnostics.push(
        Diagnostic::new(Code::NetNotOrdinary, tag_span(element), message).help(
            "leave it out if the net means the same without it; tools keep data of their own in `<toolspecific>`",
        ),
    );
}
