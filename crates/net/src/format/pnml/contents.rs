//! Contents of a net's pages: nodes and arcs by id, before references are resolved.

use super::ids::Ids;
use super::label::{number, required, text};
use super::units::Section;
use crate::format::draft::Draft;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::{ShortSpan, Source, Span};
use petril_base::xml::{Element, Event, Piece, Stream};

/// Kind of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Place,
    Transition,
}

/// Node of the net graph, or reference node.
#[derive(Debug)]
pub struct Item<'s> {
    /// Position of the id.
    pub id: Span,
    pub name: Option<Piece<'s>>,
    pub kind: Kind,
    pub tokens: u64,
    /// Position of the id that a reference node refers to.
    pub stands_for: Option<Span>,
    /// Depth and number of the page.
    pub page: (u32, u32),
}

/// Arc, by the positions of the ids at its ends.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    pub source: ShortSpan,
    pub target: ShortSpan,
    pub weight: u64,
}

/// Contents of all pages of a net, in the order of the text.
pub struct Contents<'s> {
    pub name: Option<Piece<'s>>,
    pub items: Vec<Item<'s>>,
    pub arcs: Vec<Arc>,
    pub ids: Ids<'s>,
    /// NUPN tool section.
    pub units: Option<Section<'s>>,
    pub pages: u32,
}

impl<'s> Contents<'s> {
    /// Reads a net whose tag has been read; what a safe net cannot have is recorded in the draft. Iterative, so nesting
    /// costs no stack.
    pub fn of(
        stream: &mut Stream<'s>,
        source: &'s Source,
        net: &Element<'s>,
        draft: &mut Draft,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<Self, Diagnostic> {
        let (name, units, ids) = (None, None, Ids::of(source));
        let mut contents = Self { name, items: Vec::new(), arcs: Vec::new(), ids, units, pages: 1 };
        contents.other(net, diagnostics);
        // Stack of open pages; the first entry is the net itself.
        let mut open = vec![0];
        while let (Some(&page), Some(event)) = (open.last(), stream.event()?) {
            let page = (open.len() as u32, page);
            let element = match event {
                Event::Start(element) => element,
                Event::End => {
                    open.pop();
                    continue;
                }
                Event::Text(_) => continue,
            };
            let item = |kind, is_reference| Pending { element: &element, kind, is_reference, page };
            match element.name {
                _ if element.namespace != net.namespace => {
                    foreign(stream, &element, (parent(&open), net.namespace), diagnostics)?;
                }
                "page" => {
                    contents.other(&element, diagnostics);
                    open.push(contents.pages);
                    contents.pages += 1;
                }
                "place" => contents.item(stream, &item(Kind::Place, false), draft, diagnostics)?,
                "transition" => contents.item(stream, &item(Kind::Transition, false), draft, diagnostics)?,
                "referencePlace" => contents.item(stream, &item(Kind::Place, true), draft, diagnostics)?,
                "referenceTransition" => contents.item(stream, &item(Kind::Transition, true), draft, diagnostics)?,
                "arc" => contents.arc(stream, &element, draft, diagnostics)?,
                "name" if open.len() == 1 => contents.name = text(stream)?,
                "toolspecific" if Section::is_one(&element) => {
                    let section = Section::read(stream, &element, &mut draft.warnings)?;
                    contents.units = contents.units.or(section);
                }
                "name" | "graphics" | "toolspecific" => stream.skip()?,
                _ => foreign(stream, &element, (parent(&open), net.namespace), diagnostics)?,
            }
        }
        Ok(contents)
    }

    /// Declares the id of an element that cannot be referred to.
    fn other(&mut self, element: &Element<'s>, diagnostics: &mut Vec<Diagnostic>) {
        if let Some(id) = element.attribute("id") {
            self.ids.declare(&id, None, diagnostics);
        }
    }

    fn item(
        &mut self,
        stream: &mut Stream<'s>,
        &Pending { element, kind, is_reference, page }: &Pending<'_, 's>,
        draft: &mut Draft,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<(), Diagnostic> {
        let id = required(element, "id", diagnostics);
        let stands_for = if is_reference { required(element, "ref", diagnostics) } else { None };
        let mut name = None;
        let mut marking = None;
        while let Some(label) = stream.child()? {
            match label.name {
                _ if label.namespace != element.namespace => {
                    foreign(stream, &label, (element.name, element.namespace), diagnostics)?;
                }
                "name" => name = text(stream)?.filter(|name| !name.text.is_empty()),
                "graphics" | "toolspecific" => stream.skip()?,
                "initialMarking" if kind == Kind::Place && !is_reference => {
                    let tokens = number(stream, &label, diagnostics)?;
                    once(&mut marking, tokens.unwrap_or_default(), &label, diagnostics);
                }
                _ => foreign(stream, &label, (element.name, element.namespace), diagnostics)?,
            }
        }
        let (tokens, span) = marking.map_or_else(Default::default, |(_, tokens)| tokens);
        if tokens > 1 {
            let place = name.as_ref().or(id.as_ref()).map_or("", |place| &place.text);
            let message = format!("the place `{place}` has {tokens} tokens at the beginning");
            draft.refuse(span, message, "a place of a safe net holds one token at most");
        }
        if let Some(id) = id
            && is_reference == stands_for.is_some()
        {
            self.ids.declare(&id, Some(self.items.len()), diagnostics);
            let stands_for = stands_for.map(|node| node.span);
            self.items.push(Item { id: id.span, name, kind, tokens, stands_for, page });
        }
        Ok(())
    }

    fn arc(
        &mut self,
        stream: &mut Stream<'s>,
        element: &Element<'s>,
        draft: &mut Draft,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<(), Diagnostic> {
        self.other(element, diagnostics);
        let ends = ["source", "target"].map(|end| required(element, end, diagnostics));
        let mut weight = None;
        while let Some(label) = stream.child()? {
            match label.name {
                _ if label.namespace != element.namespace => {
                    foreign(stream, &label, (element.name, element.namespace), diagnostics)?;
                }
                "name" | "graphics" | "toolspecific" => stream.skip()?,
                "inscription" => {
                    let one = inscription(stream, &label, draft, diagnostics)?;
                    once(&mut weight, one, &label, diagnostics);
                }
                _ => foreign(stream, &label, (element.name, element.namespace), diagnostics)?,
            }
        }
        if let [Some(source), Some(target)] = ends {
            let weight = weight.map_or(1, |(_, weight)| weight);
            self.arcs.push(Arc { source: source.span.into(), target: target.span.into(), weight });
        }
        Ok(())
    }
}

/// Node whose tag has been read.
struct Pending<'e, 's> {
    element: &'e Element<'s>,
    kind: Kind,
    is_reference: bool,
    page: (u32, u32),
}

/// Name of the element that encloses what is read next.
fn parent(open: &[u32]) -> &'static str {
    if open.len() == 1 { "net" } else { "page" }
}

/// Stores the value of a label with its position. A second one is an error.
fn once<T>(slot: &mut Option<(Span, T)>, value: T, label: &Element<'_>, diagnostics: &mut Vec<Diagnostic>) {
    match slot {
        None => *slot = Some((label.span, value)),
        Some((first, _)) => {
            let message = format!("a second `<{}>`", label.name);
            diagnostics.push(
                Diagnostic::new(Code::NetSyntax, label.span, message).also(*first, "the first").help("leave one"),
            );
        }
    }
}

fn inscription<'s>(
    stream: &mut Stream<'s>,
    label: &Element<'s>,
    draft: &mut Draft,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<u64, Diagnostic> {
    let Some((weight, span)) = number(stream, label, diagnostics)? else { return Ok(1) };
    if weight == 0 {
        let help = "leave the arc out, or give it a weight from 1";
        diagnostics.push(Diagnostic::new(Code::NetNotOrdinary, span, "this arc has weight 0").help(help));
    } else if weight > 1 {
        draft.refuse(span, format!("this arc has weight {weight}"), "in a safe net every arc has weight 1");
    }
    Ok(weight)
}

/// Rejects extensions of other net types and tools, such as inhibitor arcs: their meaning is unknown.
fn foreign<'s>(
    stream: &mut Stream<'s>,
    element: &Element<'s>,
    (parent, namespace): (&str, &str),
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<(), Diagnostic> {
    let of = if element.namespace == namespace { "" } else { " of another namespace" };
    let message = format!("`<{}>`{of} in `<{parent}>` is not part of place/transition nets", element.name);
    diagnostics.push(
        Diagnostic::new(Code::NetNotOrdinary, element.span, message).help(
            "leave it out if the net means the same without it; tools keep data of their own in `<toolspecific>`",
        ),
    );
    stream.skip()
}
