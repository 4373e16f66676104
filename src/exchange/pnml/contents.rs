//! What the pages of a net hold: nodes and arcs by id, before anything is known about whom they refer to.

use roxmltree::Node;

use super::label::{number, required, text};
use crate::diagnostic::{Code, Diagnostic};
use crate::exchange::draft::Draft;
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
    pub tokens: u64,
    /// The node a reference node stands for.
    pub stands_for: Option<Text>,
}

#[derive(Debug)]
pub struct Arc {
    pub source: Text,
    pub target: Text,
    pub weight: u64,
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
    /// Goes through a net; what no safe net has is noted in the draft. Pages wait in a list for their turn, so that nesting costs no recursion.
    pub fn of(net: Node<'_, '_>, draft: &mut Draft, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let mut contents = Self::default();
        let mut pages = vec![net];
        let mut next = 0;
        while let Some(&page) = pages.get(next) {
            next += 1;
            contents.other_ids.extend(attribute(page, "id"));
            for element in elements(page) {
                match tag(element) {
                    "page" => pages.push(element),
                    "place" => contents.item(element, Kind::Place, false, draft, diagnostics),
                    "transition" => contents.item(element, Kind::Transition, false, draft, diagnostics),
                    "referencePlace" => contents.item(element, Kind::Place, true, draft, diagnostics),
                    "referenceTransition" => contents.item(element, Kind::Transition, true, draft, diagnostics),
                    "arc" => contents.arc(element, draft, diagnostics),
                    "name" | "graphics" | "toolspecific" => {}
                    _ => foreign(element, page, diagnostics),
                }
            }
        }
        contents
    }

    fn item(
        &mut self,
        element: Node<'_, '_>,
        kind: Kind,
        is_reference: bool,
        draft: &mut Draft,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let id = required(element, "id", diagnostics);
        let stands_for = if is_reference { required(element, "ref", diagnostics) } else { None };
        let mut name = None;
        let mut tokens = 0;
        for label in elements(element) {
            match tag(label) {
                "name" => name = text(label).filter(|name| !name.text.is_empty()),
                "graphics" | "toolspecific" => {}
                "initialMarking" if kind == Kind::Place && !is_reference => {
                    tokens = marking(label, name.as_ref().or(id.as_ref()), draft, diagnostics);
                }
                _ => foreign(label, element, diagnostics),
            }
        }
        if let Some(id) = id
            && is_reference == stands_for.is_some()
        {
            self.items.push(Item { id, name, kind, tokens, stands_for });
        }
    }

    fn arc(&mut self, element: Node<'_, '_>, draft: &mut Draft, diagnostics: &mut Vec<Diagnostic>) {
        self.other_ids.extend(attribute(element, "id"));
        let ends = ["source", "target"].map(|end| required(element, end, diagnostics));
        let mut weight = 1;
        for label in elements(element) {
            match tag(label) {
                "name" | "graphics" | "toolspecific" => {}
                "inscription" => weight = inscription(label, draft, diagnostics),
                _ => foreign(label, element, diagnostics),
            }
        }
        if let [Some(source), Some(target)] = ends {
            self.arcs.push(Arc { source, target, weight });
        }
    }
}

fn marking(label: Node<'_, '_>, place: Option<&Text>, draft: &mut Draft, diagnostics: &mut Vec<Diagnostic>) -> u64 {
    let Some((tokens, span)) = number(label, diagnostics) else { return 0 };
    if tokens > 1 {
        let place = place.map_or("", |place| &place.text);
        let message = format!("the place `{place}` has {tokens} tokens at the beginning");
        draft.refuse(span, message, "a place of a safe net holds one token at most");
    }
    tokens
}

fn inscription(label: Node<'_, '_>, draft: &mut Draft, diagnostics: &mut Vec<Diagnostic>) -> u64 {
    let Some((weight, span)) = number(label, diagnostics) else { return 1 };
    if weight == 0 {
        let help = "leave the arc out, or give it a weight from 1";
        diagnostics.push(Diagnostic::new(Code::NetNotOrdinary, span, "this arc has weight 0").help(help));
    } else if weight > 1 {
        draft.refuse(span, format!("this arc has weight {weight}"), "in a safe net every arc has weight 1");
    }
    weight
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
