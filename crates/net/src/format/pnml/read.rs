//! Entry point of the reader: text to net, or all errors.

use std::borrow::Cow;
use std::collections::HashSet;

use super::contents::{Contents, Item, Kind};
use super::references::References;
use crate::format::draft::{Direction, Draft, DraftPlace, DraftTransition, Trouble, file_stem};
use crate::net::Located;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::{Source, Span};
use petril_base::xml::{Element, Event, Piece, Stream, attribute_at};

/// Net type of place/transition nets.
pub(super) const NET_TYPE: &str = "http://www.pnml.org/version-2009/grammar/ptnet";

/// Reads a net. Nodes are numbered in the order of the text, page by page; the span of a node is that of its name, or
/// of its id if it has no name of its own.
///
/// # Errors
/// XML is malformed, the document has no net or several, an id is a duplicate or refers to nothing, or the net has
/// labels that a place/transition net does not have.
pub fn read(source: &Source) -> Result<Located, Vec<Diagnostic>> {
    load(source).map_err(Trouble::errors)
}

/// As [`read`], but for a net that may be safe.
///
/// # Errors
/// Weights, or several tokens on a place, too.
pub fn read_safe(source: &Source) -> Result<Located, Vec<Diagnostic>> {
    load(source).map_err(Trouble::all).and_then(Located::safe)
}

fn load(source: &Source) -> Result<Located, Trouble> {
    let mut diagnostics = Vec::new();
    let mut draft = Draft::default();
    let (net, contents) = the_net(source, &mut draft, &mut diagnostics).map_err(|diagnostic| vec![diagnostic])?;
    let name = contents.name.clone().or_else(|| net.attribute("id")).map(|name| name.text.into_owned());
    fill(source, &mut draft, contents, &mut diagnostics);
    let name = || name.filter(|name| !name.is_empty()).unwrap_or_else(|| file_stem(source));
    draft.finish(name, diagnostics)
}

/// The only net of a document, or the reason why the document is rejected as a whole.
fn the_net<'s>(
    source: &'s Source,
    draft: &mut Draft,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<(Element<'s>, Contents<'s>), Diagnostic> {
    let mut stream = Stream::of(source, Code::NetSyntax, "PNML")?;
    let refuse = |span, message: String| Diagnostic::new(Code::NetSyntax, span, message);
    let mut root = Span::default();
    let mut nets: Vec<Span> = Vec::new();
    let mut found = None;
    while let Some(event) = stream.event()? {
        match event {
            Event::Start(element) if root == Span::default() => {
                root = element.span;
                if element.name != "pnml" {
                    let help = "a PNML document begins with `<pnml>`";
                    return Err(refuse(root, format!("this is no PNML but `<{}>`", element.name)).help(help));
                }
            }
            Event::Start(element) if element.name == "net" => {
                nets.push(element.span);
                let unfit = found.is_none().then(|| other_type(&element));
                match unfit {
                    Some(None) => {
                        let contents = Contents::of(&mut stream, source, &element, draft, diagnostics)?;
                        found = Some(Ok((element, contents)));
                    }
                    Some(Some(diagnostic)) => {
                        found = Some(Err(diagnostic));
                        stream.skip()?;
                    }
                    None => stream.skip()?,
                }
            }
            Event::Start(_) => stream.skip()?,
            Event::End | Event::Text(_) => {}
        }
    }
    match (found, &nets[..]) {
        (Some(net), [_]) => net,
        (_, [first, second, ..]) => {
            let diagnostic = refuse(*second, format!("this document holds {} nets", nets.len()));
            let diagnostic = diagnostic.here("the second net").also(*first, "the first");
            Err(diagnostic.help("put each net in a file of its own"))
        }
        _ => Err(refuse(root, "this document holds no net".to_owned())),
    }
}

/// Diagnostic for a net that is not a place/transition net.
fn other_type(net: &Element<'_>) -> Option<Diagnostic> {
    let (span, found) = match net.attribute("type") {
        Some(Piece { text, .. }) if text == NET_TYPE => return None,
        Some(Piece { text, span }) => (span, format!("this net has the type `{text}`")),
        None => (net.span, "this net has no type".to_owned()),
    };
    let help = format!("only place/transition nets are read: `type=\"{NET_TYPE}\"`");
    Some(Diagnostic::new(Code::NetSyntax, span, found).help(help))
}

/// Converts the contents to places and transitions.
fn fill<'s>(source: &'s Source, draft: &mut Draft, mut contents: Contents<'s>, diagnostics: &mut Vec<Diagnostic>) {
    let mut order: Vec<u32> = (0..contents.items.len() as u32).collect();
    if contents.pages > 1 {
        // Outer pages come first.
        order.sort_by_key(|&item| contents.items[item as usize].page);
    }
    let names = names(source, &contents.items, &order);
    let (mut place_ids, mut transition_ids) = (Vec::new(), Vec::new());
    // Position of each item among the places, or among the transitions.
    let mut positions = vec![0; contents.items.len()];
    for (&position, Piece { text, span }) in order.iter().zip(names) {
        let item = &contents.items[position as usize];
        if item.stands_for.is_some() {
            continue;
        }
        let (id, name) = (attribute_at(source, item.id).into_owned(), text.into_owned());
        match item.kind {
            Kind::Place => {
                positions[position as usize] = draft.places.len() as u32;
                place_ids.push(id);
                draft.places.push(DraftPlace { name, span, tokens: item.tokens });
            }
            Kind::Transition => {
                positions[position as usize] = draft.transitions.len() as u32;
                transition_ids.push(id);
                draft.transitions.push(DraftTransition { name, span });
            }
        }
    }
    draft.ids = Some((place_ids, transition_ids));
    draft.units = contents.units.take().and_then(|section| section.units(&contents, &positions, draft));
    let references = References::of(&contents, source, diagnostics);
    for arc in &contents.arcs {
        let (source_span, target_span) = (Span::from(arc.source), Span::from(arc.target));
        let span = source_span.to(target_span);
        let ends = [source_span, target_span].map(|id| {
            references.find(id).unwrap_or_else(|diagnostic| {
                diagnostics.push(*diagnostic);
                None
            })
        });
        let [Some(from), Some(to)] = ends else { continue };
        let position = |item: usize| positions[item] as usize;
        match (contents.items[from].kind, contents.items[to].kind) {
            (Kind::Place, Kind::Transition) => {
                draft.arc(position(to), Direction::Consume, position(from), arc.weight, span);
            }
            (Kind::Transition, Kind::Place) => {
                draft.arc(position(from), Direction::Produce, position(to), arc.weight, span);
            }
            (kind, _) => {
                let kind = if kind == Kind::Place { "places" } else { "transitions" };
                let [from, to] = [source_span, target_span].map(|id| attribute_at(source, id));
                let message = format!("this arc joins two {kind}, `{from}` and `{to}`");
                diagnostics.push(
                    Diagnostic::new(Code::NetReference, span, message).help("an arc joins a place and a transition"),
                );
            }
        }
    }
}

/// Names of the items, in this order, unique among places and among transitions: an item's name unless an earlier one
/// has it, else its id, with a number appended in the rare case that another node has that name.
fn names<'s>(source: &'s Source, items: &[Item<'s>], order: &[u32]) -> Vec<Piece<'s>> {
    let mut taken: [HashSet<Cow<'s, str>>; 2] = [HashSet::new(), HashSet::new()];
    let items = || order.iter().map(|&item| &items[item as usize]);
    let named: Vec<Option<&Piece<'s>>> = items()
        .map(|item| {
            let name = item.name.as_ref().filter(|_| item.stands_for.is_none());
            name.filter(|name| taken[item.kind as usize].insert(name.text.clone()))
        })
        .collect();
    let mut numbers = 2..;
    let name = |(item, name): (&Item<'s>, Option<&Piece<'s>>)| match name {
        Some(name) => name.clone(),
        None => {
            let id = attribute_at(source, item.id);
            let mut text = id.clone();
            while item.stands_for.is_none() && !taken[item.kind as usize].insert(text.clone()) {
                text = Cow::Owned(format!("{id}'{}", numbers.next().unwrap_or(0)));
            }
            Piece { text, span: item.id }
        }
    };
    items().zip(named).map(name).collect()
}
