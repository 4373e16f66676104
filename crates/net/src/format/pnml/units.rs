//! Tool section of nested-unit Petri nets (NUPN 1.1). A section that does not fit its net is dropped with a warning:
//! the net is the same without it.

use std::collections::HashMap;

use super::contents::{Contents, Kind};
use crate::format::draft::Draft;
use crate::net::{PlaceId, Unit, Units};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_base::xml::{Element, Event, Piece, Stream};

/// Section as written in the file.
pub struct Section<'s> {
    span: Span,
    /// Declared numbers of places, transitions and arcs.
    sizes: Vec<(&'static str, Piece<'s>)>,
    /// Declared number of units.
    count: Option<Piece<'s>>,
    root: Option<Piece<'s>>,
    safe: bool,
    units: Vec<DraftUnit<'s>>,
}

struct DraftUnit<'s> {
    id: Piece<'s>,
    places: Option<Piece<'s>>,
    subunits: Option<Piece<'s>>,
}

impl<'s> Section<'s> {
    /// Whether a tool section is a NUPN section.
    pub fn is_one(element: &Element<'_>) -> bool {
        element.attribute("tool").is_some_and(|tool| tool.text == "nupn")
    }

    /// Reads the section that began last.
    pub fn read(
        stream: &mut Stream<'s>,
        element: &Element<'s>,
        warnings: &mut Vec<Diagnostic>,
    ) -> Result<Option<Self>, Diagnostic> {
        let span = element.span;
        let mut section = Self { span, sizes: Vec::new(), count: None, root: None, safe: false, units: Vec::new() };
        // Levels: section, structure, unit.
        let mut depth = 1;
        while let Some(event) = stream.event()? {
            let element = match event {
                Event::Start(element) => element,
                Event::End if depth == 1 => break,
                Event::End => {
                    depth -= 1;
                    continue;
                }
                Event::Text(_) => continue,
            };
            match (depth, element.name) {
                (1, "size") => {
                    let sizes = ["places", "transitions", "arcs"].map(|of| Some((of, element.attribute(of)?)));
                    section.sizes.extend(sizes.into_iter().flatten());
                    stream.skip()?;
                }
                (1, "structure") if section.root.is_none() => {
                    section.count = element.attribute("units");
                    section.root = element.attribute("root");
                    section.safe = element.attribute("safe").is_some_and(|safe| safe.text == "true");
                    depth = 2;
                }
                (2, "unit") => {
                    let id = element.attribute("id");
                    let id = id.unwrap_or_else(|| Piece { text: "".into(), span: element.span });
                    section.units.push(DraftUnit { id, places: None, subunits: None });
                    depth = 3;
                }
                (3, "places" | "subunits") => {
                    let content = Some(stream.content(&element)?);
                    match section.units.last_mut() {
                        Some(unit) if element.name == "places" => unit.places = content,
                        Some(unit) => unit.subunits = content,
                        None => {}
                    }
                }
                _ => stream.skip()?,
            }
        }
        if section.root.is_none() {
            warn(warnings, span, "this NUPN section has no `<structure>` with a root, and is left out".to_owned());
            return Ok(None);
        }
        Ok(Some(section))
    }

    /// Units of the net; `positions` are those of the items among the places.
    pub fn units(&self, contents: &Contents<'s>, positions: &[u32], draft: &mut Draft) -> Option<Units> {
        let counts = [draft.places.len(), draft.transitions.len(), contents.arcs.len()];
        for ((of, size), count) in self.sizes.iter().filter_map(|size| {
            let position = ["places", "transitions", "arcs"].iter().position(|of| *of == size.0)?;
            Some((size, counts[position]))
        }) {
            if size.text.parse() != Ok(count) {
                warn(&mut draft.warnings, size.span, format!("the number of {of} is {count}, not {}", size.text));
            }
        }
        if let Some(count) = self.count.as_ref().filter(|count| count.text.parse() != Ok(self.units.len())) {
            let message = format!("the number of units is {}, not {}", self.units.len(), count.text);
            warn(&mut draft.warnings, count.span, message);
        }
        let mut misfits = Vec::new();
        let units = self.tree(contents, positions, draft, &mut misfits);
        if misfits.is_empty() {
            return units;
        }
        draft.warnings.extend(misfits.into_iter().map(|(span, message)| {
            Diagnostic::new(Code::UnitsUnfit, span, message)
                .help("the units are left out; the net is the same without them")
        }));
        None
    }

    /// Units, if they form a tree with each place in exactly one of them.
    fn tree(
        &self,
        contents: &Contents<'s>,
        positions: &[u32],
        draft: &mut Draft,
        misfits: &mut Vec<(Span, String)>,
    ) -> Option<Units> {
        let mut by_id = HashMap::new();
        for (position, unit) in self.units.iter().enumerate() {
            if by_id.insert(unit.id.text.as_ref(), position).is_some() {
                misfits.push((unit.id.span, format!("there are two units `{}`", unit.id.text)));
            }
        }
        let mut unit_of: Vec<Option<usize>> = vec![None; draft.places.len()];
        let mut parent: Vec<Option<usize>> = vec![None; self.units.len()];
        let mut units = Vec::with_capacity(self.units.len());
        for (position, unit) in self.units.iter().enumerate() {
            let (mut places, mut subunits) = (Vec::new(), Vec::new());
            for (span, id) in unit.places.iter().flat_map(words) {
                let item = contents.ids.find(id).flatten().filter(|&item| {
                    contents.items[item].kind == Kind::Place && contents.items[item].stands_for.is_none()
                });
                match item.map(|item| positions[item] as usize) {
                    None => misfits.push((span, format!("the net has no place `{id}`"))),
                    Some(place) if unit_of[place].is_some() => {
                        misfits.push((span, format!("the place `{id}` is in two units")));
                    }
                    Some(place) => {
                        unit_of[place] = Some(position);
                        places.push(PlaceId::at(place));
                    }
                }
            }
            for (span, id) in unit.subunits.iter().flat_map(words) {
                match by_id.get(id) {
                    None => misfits.push((span, format!("there is no unit `{id}`"))),
                    Some(&inner) if parent[inner].is_some() => {
                        misfits.push((span, format!("the unit `{id}` is in two units")));
                    }
                    Some(&inner) => {
                        parent[inner] = Some(position);
                        subunits.push(inner);
                    }
                }
            }
            units.push(Unit { id: unit.id.text.clone().into_owned(), places, subunits });
        }
        let root_id = self.root.as_ref()?;
        let Some(&root) = by_id.get(root_id.text.as_ref()) else {
            misfits.push((root_id.span, format!("there is no unit `{}`", root_id.text)));
            return None;
        };
        if let Some(place) = unit_of.iter().position(Option::is_none) {
            misfits.push((self.span, format!("the place `{}` is in no unit", draft.places[place].name)));
        }
        // Every unit has at most one parent, so it is below the root, without parent, or on a cycle.
        let mut below = vec![root];
        let mut next = 0;
        while let Some(&unit) = below.get(next).filter(|_| below.len() <= units.len()) {
            below.extend(&units[unit].subunits);
            next += 1;
        }
        if parent[root].is_some() || below.len() != units.len() {
            misfits.push((root_id.span, format!("not every unit is within `{}`", root_id.text)));
        }
        if !misfits.is_empty() {
            return None;
        }
        let mut units = Units { units, root, safe: self.safe };
        if units.safe && !fits_the_beginning(&units, &below, &unit_of, draft) {
            let message = "the net does not begin with one place of each unit marked at most".to_owned();
            warn(&mut draft.warnings, self.span, message);
            units.safe = false;
        }
        Some(units)
    }
}

/// Whether the initial marking is that of a unit-safe net. `order` lists units after those that contain them.
fn fits_the_beginning(units: &Units, order: &[usize], unit_of: &[Option<usize>], draft: &Draft) -> bool {
    let mut tokens: Vec<u64> = vec![0; units.units.len()];
    for (place, unit) in draft.places.iter().zip(unit_of) {
        if let Some(unit) = unit {
            tokens[*unit] = tokens[*unit].saturating_add(place.tokens);
        }
    }
    // Whether a place of the unit or of an enclosing one is marked.
    let mut is_marked = vec![false; units.units.len()];
    order.iter().all(|&unit| {
        let fits = tokens[unit] == 0 || (tokens[unit] == 1 && !is_marked[unit]);
        is_marked[unit] |= tokens[unit] > 0;
        let here = is_marked[unit];
        units.units[unit].subunits.iter().for_each(|&inner| is_marked[inner] |= here);
        fits
    })
}

fn warn(warnings: &mut Vec<Diagnostic>, span: Span, message: String) {
    warnings.push(Diagnostic::new(Code::UnitsUnfit, span, message));
}

/// Words of a text with their positions, exact if the text contains no entities or comments.
fn words<'p>(piece: &'p Piece<'_>) -> impl Iterator<Item = (Span, &'p str)> {
    let text: &str = &piece.text;
    let is_as_written = text.len() == piece.span.end - piece.span.start;
    text.split_whitespace().map(move |word| {
        let start = word.as_ptr() as usize - text.as_ptr() as usize;
        let span = Span::new(piece.span.start + start, piece.span.start + start + word.len());
        (if is_as_written { span } else { piece.span }, word)
    })
}
