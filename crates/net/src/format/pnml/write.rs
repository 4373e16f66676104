//! Writer: net to PNML.

use std::borrow::Cow;
use std::collections::HashSet;
use std::io;

use quick_xml::Writer;
use quick_xml::events::attributes::Attribute;
use quick_xml::events::{BytesDecl, BytesText, Event};
use quick_xml::name::QName;

use super::extras::{Note, Notes, Point, Positions};
use super::read::NET_TYPE;
use crate::net::{Net, PlaceId, Units};
use petril_base::printable;
use petril_base::to_text;
use petril_base::xml::written;

type Xml<'o> = Writer<&'o mut dyn io::Write>;

/// Additional contents of a document.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extras<'e> {
    /// Positions of the nodes.
    pub positions: Option<&'e Positions>,
    /// Annotations of the nodes, in tool sections of Petril.
    pub notes: Option<&'e Notes>,
    /// Units of the places, in a tool section that many tools know (NUPN 1.1).
    pub units: Option<&'e Units>,
    /// Ids of places and transitions in their original file. Those that are not valid in XML are replaced.
    pub ids: Option<&'e (Vec<String>, Vec<String>)>,
}

/// Writes a net on one page; a read arc becomes a loop of two arcs. Names become labels; without given ids, nodes are
/// called `p0`, `p1`, … and `t0`, `t1`, ….
///
/// Reading the document gives the same net, unless a name begins or ends with blanks or has a control character that
/// XML cannot represent; other characters that are not printable become character references.
///
/// # Errors
/// Errors of the output.
pub fn write_to(net: &Net, extras: Extras<'_>, out: &mut dyn io::Write) -> io::Result<()> {
    let ids = Ids::of(extras.ids);
    let mut xml = Writer::new_with_indent(out, b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = xml.create_element("pnml").with_attribute(("xmlns", "http://www.pnml.org/version-2009/grammar/pnml"));
    root.write_inner_content(|xml| {
        let element = xml.create_element("net").with_attributes([("id", ids.free("net").as_ref()), ("type", NET_TYPE)]);
        element.write_inner_content(|xml| {
            label(xml, "name", net.name())?;
            let element = xml.create_element("page").with_attribute(("id", ids.free("page").as_ref()));
            element.write_inner_content(|xml| page(xml, net, &ids, extras)).map(drop)
        })?;
        Ok(())
    })?;
    writeln!(xml.into_inner())
}

/// As [`write_to`], to a string.
#[must_use]
pub fn write(net: &Net, extras: Extras<'_>) -> String {
    to_text(|out| write_to(net, extras, out))
}

fn page(xml: &mut Xml<'_>, net: &Net, ids: &Ids<'_>, extras: Extras<'_>) -> io::Result<()> {
    for (i, place) in net.places().enumerate() {
        let element = xml.create_element("place").with_attribute(("id", ids.place(i).as_ref()));
        element.write_inner_content(|xml| {
            label(xml, "name", place.name)?;
            graphics(xml, extras.positions.map(|positions| positions.places[i]))?;
            tool_section(xml, extras.notes.map(|notes| &notes.places[i]))?;
            if place.is_marked() { label(xml, "initialMarking", &place.tokens.to_string()) } else { Ok(()) }
        })?;
    }
    for (i, transition) in net.transitions().enumerate() {
        let element = xml.create_element("transition").with_attribute(("id", ids.transition(i).as_ref()));
        element.write_inner_content(|xml| {
            label(xml, "name", transition.name)?;
            graphics(xml, extras.positions.map(|positions| positions.transitions[i]))?;
            tool_section(xml, extras.notes.map(|notes| &notes.transitions[i]))
        })?;
    }
    let mut arcs = 0..;
    for (i, id) in net.transition_ids().enumerate() {
        let here = ids.transition(i);
        let mut arc = |xml: &mut Xml<'_>, source: &str, target: &str, weight: u64| {
            let id = format!("a{}", arcs.next().unwrap_or_default());
            let element = xml.create_element("arc");
            let element =
                element.with_attributes([("id", ids.free(&id).as_ref()), ("source", source), ("target", target)]);
            match weight {
                1 => element.write_empty(),
                _ => element.write_inner_content(|xml| label(xml, "inscription", &weight.to_string())),
            }
            .map(drop)
        };
        let read = net.arcs(id).read;
        let is_read = |place: PlaceId| read.binary_search(&place).is_ok();
        for (place, weight) in net.taken(id).filter(|&(place, _)| !is_read(place)) {
            arc(xml, &ids.place(place.index()), &here, weight)?;
        }
        for (place, weight) in net.read(id) {
            let name = ids.place(place.index());
            arc(xml, &name, &here, weight + on(net.taken(id), place))?;
            arc(xml, &here, &name, weight + on(net.put(id), place))?;
        }
        for (place, weight) in net.put(id).filter(|&(place, _)| !is_read(place)) {
            arc(xml, &here, &ids.place(place.index()), weight)?;
        }
    }
    extras.units.map_or(Ok(()), |units| unit_section(xml, net, ids, units))
}

/// Weight of a place in a list; 0 if absent.
fn on(mut arcs: impl Iterator<Item = (PlaceId, u64)>, place: PlaceId) -> u64 {
    arcs.find(|&(other, _)| other == place).map_or(0, |(_, weight)| weight)
}

fn label(xml: &mut Xml<'_>, name: &str, text: &str) -> io::Result<()> {
    let text = written(text);
    let element = xml.create_element(name);
    let write =
        |xml: &mut Xml<'_>| xml.create_element("text").write_text_content(BytesText::from_escaped(&text)).map(drop);
    element.write_inner_content(write).map(drop)
}

fn graphics(xml: &mut Xml<'_>, point: Option<Point>) -> io::Result<()> {
    let Some(Point { x, y }) = point else { return Ok(()) };
    let (x, y) = (x.to_string(), y.to_string());
    let write = |xml: &mut Xml<'_>| {
        let element = xml.create_element("position");
        element.with_attributes([("x", x.as_str()), ("y", y.as_str())]).write_empty().map(drop)
    };
    xml.create_element("graphics").write_inner_content(write).map(drop)
}

fn tool_section(xml: &mut Xml<'_>, note: Option<&Note>) -> io::Result<()> {
    let Some(note) = note else { return Ok(()) };
    let element = xml.create_element("toolspecific").with_attributes([("tool", "petril"), ("version", "0.1")]);
    let write = |xml: &mut Xml<'_>| {
        let texts: Vec<String> = note.iter().map(|(_, value)| written(value)).collect();
        let pairs = note
            .iter()
            .zip(&texts)
            .map(|((word, _), text)| Attribute { key: QName(word), value: text.as_str().into() });
        xml.create_element("stands-for").with_attributes(pairs).write_empty().map(drop)
    };
    element.write_inner_content(write).map(drop)
}

fn unit_section(xml: &mut Xml<'_>, net: &Net, ids: &Ids<'_>, units: &Units) -> io::Result<()> {
    let count = |count: usize| count.to_string();
    let words = |words: Vec<Cow<'_, str>>| words.join(" ");
    let element = xml.create_element("toolspecific").with_attributes([("tool", "nupn"), ("version", "1.1")]);
    let write = |xml: &mut Xml<'_>| {
        let sizes = [count(net.places().len()), count(net.transitions().len()), count(net.arc_count())];
        let sizes = ["places", "transitions", "arcs"].into_iter().zip(sizes.iter().map(String::as_str));
        xml.create_element("size").with_attributes(sizes).write_empty()?;
        let (all, root) = (count(units.units.len()), printable::line(&units.units[units.root].id));
        let safe = if units.safe { "true" } else { "false" };
        let element = xml.create_element("structure");
        let element = element.with_attributes([("units", all.as_str()), ("root", root.as_str()), ("safe", safe)]);
        element.write_inner_content(|xml| {
            for unit in &units.units {
                let places = words(unit.places.iter().map(|place| ids.place(place.index())).collect());
                let subunits = words(
                    unit.subunits.iter().map(|&unit| Cow::from(printable::line(&units.units[unit].id))).collect(),
                );
                let element = xml.create_element("unit").with_attribute(("id", printable::line(&unit.id).as_str()));
                element.write_inner_content(|xml| {
                    for (name, text) in [("places", &places), ("subunits", &subunits)] {
                        let element = xml.create_element(name);
                        match text.is_empty() {
                            true => element.write_empty()?,
                            false => element.write_text_content(BytesText::new(text))?,
                        };
                    }
                    Ok(())
                })?;
            }
            Ok(())
        })?;
        Ok(())
    };
    element.write_inner_content(write).map(drop)
}

/// Ids of a document, all different.
struct Ids<'e> {
    places: &'e [String],
    transitions: &'e [String],
    kept: HashSet<&'e str>,
}

impl<'e> Ids<'e> {
    /// Keeps the ids that are valid in a document.
    fn of(ids: Option<&'e (Vec<String>, Vec<String>)>) -> Self {
        let (places, transitions): (&[String], &[String]) = ids.map_or((&[], &[]), |(p, t)| (p, t));
        let kept = places.iter().chain(transitions).map(String::as_str).filter(|id| is_id(id)).collect();
        Self { places, transitions, kept }
    }

    fn place(&self, position: usize) -> Cow<'e, str> {
        self.node(self.places, "p", position)
    }

    fn transition(&self, position: usize) -> Cow<'e, str> {
        self.node(self.transitions, "t", position)
    }

    fn node(&self, ids: &'e [String], letter: &str, position: usize) -> Cow<'e, str> {
        match ids.get(position).filter(|id| self.kept.contains(id.as_str())) {
            Some(id) => Cow::Borrowed(id),
            None => Cow::Owned(self.free(&format!("{letter}{position}")).into_owned()),
        }
    }

    /// An id, with underscores appended while it is taken.
    fn free<'i>(&self, id: &'i str) -> Cow<'i, str> {
        let mut id = Cow::Borrowed(id);
        while self.kept.contains(id.as_ref()) {
            id.to_mut().push('_');
        }
        id
    }
}

/// Whether a text is a name without colon in ASCII (XML 1.0, fourth edition), so that every tool accepts it.
fn is_id(id: &str) -> bool {
    id.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && id.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.'))
}
