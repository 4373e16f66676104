//! The front door: text to net, or every error of the text.

use std::collections::HashSet;

use roxmltree::{Document, Node};

use super::contents::{Contents, Item, Kind};
use super::label::text;
use super::references::References;
use crate::diagnostic::{Code, Diagnostic};
use crate::exchange::draft::{Arc, Draft, DraftPlace, DraftTransition, Trouble, file_stem};
use crate::net::Located;
use crate::source::Source;
use crate::xml::{self, Text, attribute, elements, tag, tag_span};

/// The type of place/transition nets.
pub(super) const NET_TYPE: &str = "http://www.pnml.org/version-2009/grammar/ptnet";

/// Reads a net. Nodes are numbered in the order of the text, page by page; the span of a node is its name's, or its id's if
/// it goes by that.
///
/// # Errors
/// XML that is not well-formed, documents with no net or several, ids that are given twice or to nobody, and what a
/// place/transition net does not have: labels of other net types.
pub fn read(source: &Source) -> Result<Located, Vec<Diagnostic>> {
    load(source).map_err(Trouble::errors)
}

/// As [`read`], but for a net that can be safe.
///
/// # Errors
/// Weights and several tokens on a place, too.
pub fn read_safe(source: &Source) -> Result<Located, Vec<Diagnostic>> {
    load(source).map_err(Trouble::all).and_then(Located::safe)
}

fn load(source: &Source) -> Result<Located, Trouble> {
    let document = xml::document(source, Code::NetSyntax, "PNML").map_err(|diagnostic| vec![diagnostic])?;
    let net = the_net(&document).map_err(|diagnostic| vec![*diagnostic])?;
    let mut diagnostics = Vec::new();
    let mut draft = Draft::default();
    let contents = Contents::of(net, &mut draft, &mut diagnostics);
    let references = References::of(&contents, &mut diagnostics);
    fill(&mut draft, &contents, &references, &mut diagnostics);
    let name = || {
        let name = elements(net).find(|&child| tag(child) == "name").and_then(text).or_else(|| attribute(net, "id"));
        name.map(|name| name.text).filter(|name| !name.is_empty()).unwrap_or_else(|| file_stem(source))
    };
    draft.finish(name, diagnostics)
}

/// The one net of a document.
fn the_net<'a, 'i>(document: &'a Document<'i>) -> Result<Node<'a, 'i>, Box<Diagnostic>> {
    let root = document.root_element();
    let refuse = |span, message: String| Box::new(Diagnostic::new(Code::NetSyntax, span, message));
    if tag(root) != "pnml" {
        let help = "a PNML document begins with `<pnml>`";
        return Err(Box::new(refuse(tag_span(root), format!("this is no PNML but `<{}>`", tag(root))).help(help)));
    }
    let mut nets = elements(root).filter(|&element| tag(element) == "net");
    let net = nets.next().ok_or_else(|| refuse(tag_span(root), "this document holds no net".to_owned()))?;
    if let Some(second) = nets.next() {
        let message = format!("this document holds {} nets", nets.count() + 2);
        let diagnostic = refuse(tag_span(second), message).here("the second net").also(tag_span(net), "the first");
        return Err(Box::new(diagnostic.help("put each net in a file of its own")));
    }
    let (span, found) = match attribute(net, "type") {
        Some(Text { text, .. }) if text == NET_TYPE => return Ok(net),
        Some(Text { text, span }) => (span, format!("this net has the type `{text}`")),
        None => (tag_span(net), "this net has no type".to_owned()),
    };
    Err(Box::new(refuse(span, found).help(format!("only place/transition nets are read: `type=\"{NET_TYPE}\"`"))))
}

/// The net in terms of places and transitions.
fn fill(draft: &mut Draft, contents: &Contents, references: &References<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let (mut place_ids, mut transition_ids) = (Vec::new(), Vec::new());
    // Position of each item among the places, or among the transitions.
    let mut positions = Vec::with_capacity(contents.items.len());
    for (item, Text { text: name, span }) in contents.items.iter().zip(names(&contents.items)) {
        positions.push(match item.kind {
            Kind::Place => draft.places.len(),
            Kind::Transition => draft.transitions.len(),
        });
        match (&item.stands_for, item.kind) {
            (Some(_), _) => {}
            (None, Kind::Place) => {
                place_ids.push(item.id.text.clone());
                draft.places.push(DraftPlace { name, span, tokens: item.tokens });
            }
            (None, Kind::Transition) => {
                transition_ids.push(item.id.text.clone());
                draft.transitions.push(DraftTransition::new(name, span));
            }
        }
    }
    for arc in &contents.arcs {
        let ends = [&arc.source, &arc.target].map(|id| {
            references.find(id).unwrap_or_else(|diagnostic| {
                diagnostics.push(*diagnostic);
                None
            })
        });
        let [Some(from), Some(to)] = ends else { continue };
        let at = |place: usize| Arc {
            place: positions[place],
            weight: arc.weight,
            span: arc.source.span.to(arc.target.span),
        };
        match (contents.items[from].kind, contents.items[to].kind) {
            (Kind::Place, Kind::Transition) => draft.transitions[positions[to]].consume.push(at(from)),
            (Kind::Transition, Kind::Place) => draft.transitions[positions[from]].produce.push(at(to)),
            (kind, _) => {
                let kind = if kind == Kind::Place { "places" } else { "transitions" };
                let message = format!("this arc joins two {kind}, `{}` and `{}`", arc.source.text, arc.target.text);
                diagnostics.push(
                    Diagnostic::new(Code::NetReference, at(from).span, message)
                        .help("an arc joins a place and a transition"),
                );
            }
        }
    }
    draft.ids = Some((place_ids, transition_ids));
}

/// What each item is called, unique among places and among transitions: its name unless an earlier one has it, else its id,
/// with a number behind it in the odd case that this is another's name.
fn names(items: &[Item]) -> Vec<Text> {
    let mut taken = [HashSet::new(), HashSet::new()];
    let named: Vec<Option<&Text>> = items
        .iter()
        .map(|item| {
            let name = item.name.as_ref().filter(|_| item.stands_for.is_none());
            name.filter(|name| taken[item.kind as usize].insert(name.text.clone()))
        })
        .collect();
    let mut numbers = 2..;
    let name = |(item, name): (&Item, Option<&Text>)| match name {
        Some(name) => name.clone(),
        None => {
            let Text { mut text, span } = item.id.clone();
            while item.stands_for.is_none() && !taken[item.kind as usize].insert(text.clone()) {
                text = format!("{}'{}", item.id.text, numbers.next().unwrap_or(0));
            }
            Text { text, span }
        }
    };
    items.iter().zip(named).map(name).collect()
}
