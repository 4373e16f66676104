//! Net to text.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use super::read::NET_TYPE;
use crate::draw::{Point, Positions, printable};
use crate::exchange::notes::{Note, Notes};
use crate::net::{Net, PlaceId};

type Xml = Writer<Vec<u8>>;

/// Writes a net on one page, a read arc as a loop of two arcs. Ids are `p0`, `p1`, … and `t0`, `t1`, …; the readable names
/// are labels. Positions go to the graphics of the nodes, notes to tool sections of Petril's.
///
/// Reading it back gives the same net, unless a name begins or ends with blanks or holds control characters, which XML
/// cannot keep.
#[must_use]
pub fn write(net: &Net, positions: Option<&Positions>, notes: Option<&Notes>) -> String {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    document(&mut xml, net, positions, notes).expect("memory takes everything that is written to it");
    let mut text = String::from_utf8_lossy(&xml.into_inner()).into_owned();
    text.push('\n');
    text
}

fn document(xml: &mut Xml, net: &Net, positions: Option<&Positions>, notes: Option<&Notes>) -> io::Result<()> {
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = xml.create_element("pnml").with_attribute(("xmlns", "http://www.pnml.org/version-2009/grammar/pnml"));
    root.write_inner_content(|xml| {
        let element = xml.create_element("net").with_attributes([("id", "net"), ("type", NET_TYPE)]);
        element.write_inner_content(|xml| {
            label(xml, "name", net.name())?;
            let element = xml.create_element("page").with_attribute(("id", "page"));
            element.write_inner_content(|xml| page(xml, net, positions, notes)).map(drop)
        })?;
        Ok(())
    })?;
    Ok(())
}

fn page(xml: &mut Xml, net: &Net, positions: Option<&Positions>, notes: Option<&Notes>) -> io::Result<()> {
    for (i, place) in net.places().enumerate() {
        let element = xml.create_element("place").with_attribute(("id", format!("p{i}").as_str()));
        element.write_inner_content(|xml| {
            label(xml, "name", place.name)?;
            graphics(xml, positions.map(|positions| positions.places[i]))?;
            tool_section(xml, notes.map(|notes| &notes.places[i]))?;
            if place.is_marked() { label(xml, "initialMarking", &place.tokens.to_string()) } else { Ok(()) }
        })?;
    }
    for (i, transition) in net.transitions().enumerate() {
        let element = xml.create_element("transition").with_attribute(("id", format!("t{i}").as_str()));
        element.write_inner_content(|xml| {
            label(xml, "name", transition.name)?;
            graphics(xml, positions.map(|positions| positions.transitions[i]))?;
            tool_section(xml, notes.map(|notes| &notes.transitions[i]))
        })?;
    }
    let mut arcs = 0..;
    for (i, id) in net.transition_ids().enumerate() {
        let here = format!("t{i}");
        let mut arc = |xml: &mut Xml, source: &str, target: &str, weight: u64| {
            let id = format!("a{}", arcs.next().unwrap_or_default());
            let element = xml.create_element("arc");
            let element = element.with_attributes([("id", id.as_str()), ("source", source), ("target", target)]);
            match weight {
                1 => element.write_empty(),
                _ => element.write_inner_content(|xml| label(xml, "inscription", &weight.to_string())),
            }
            .map(drop)
        };
        let read = net.arcs(id).read;
        let is_read = |place: PlaceId| read.binary_search(&place).is_ok();
        for (place, weight) in net.taken(id).filter(|&(place, _)| !is_read(place)) {
            arc(xml, &format!("p{}", place.index()), &here, weight)?;
        }
        for (place, weight) in net.read(id) {
            let name = format!("p{}", place.index());
            arc(xml, &name, &here, weight + on(net.taken(id), place))?;
            arc(xml, &here, &name, weight + on(net.put(id), place))?;
        }
        for (place, weight) in net.put(id).filter(|&(place, _)| !is_read(place)) {
            arc(xml, &here, &format!("p{}", place.index()), weight)?;
        }
    }
    Ok(())
}

/// The weight of a place in a list; 0 if it is not there.
fn on(mut arcs: impl Iterator<Item = (PlaceId, u64)>, place: PlaceId) -> u64 {
    arcs.find(|&(other, _)| other == place).map_or(0, |(_, weight)| weight)
}

fn label(xml: &mut Xml, name: &str, text: &str) -> io::Result<()> {
    let text = printable(text);
    let element = xml.create_element(name);
    let write = |xml: &mut Xml| xml.create_element("text").write_text_content(BytesText::new(&text)).map(drop);
    element.write_inner_content(write).map(drop)
}

fn graphics(xml: &mut Xml, point: Option<Point>) -> io::Result<()> {
    let Some(Point { x, y }) = point else { return Ok(()) };
    let (x, y) = (x.to_string(), y.to_string());
    let write = |xml: &mut Xml| {
        let element = xml.create_element("position");
        element.with_attributes([("x", x.as_str()), ("y", y.as_str())]).write_empty().map(drop)
    };
    xml.create_element("graphics").write_inner_content(write).map(drop)
}

fn tool_section(xml: &mut Xml, note: Option<&Note>) -> io::Result<()> {
    let Some(note) = note else { return Ok(()) };
    let element = xml.create_element("toolspecific").with_attributes([("tool", "petril"), ("version", "0.1")]);
    let write = |xml: &mut Xml| {
        let pairs = note.iter().map(|(word, value)| (*word, value.as_str()));
        xml.create_element("stands-for").with_attributes(pairs).write_empty().map(drop)
    };
    element.write_inner_content(write).map(drop)
}
