//! The picture of the whole system net: one block for each control place, laid out in columns like a newspaper.
//!
//! First the PLC's cycle and the program, from `idle` to `End`; then the plant, one block for each component; then the bits.
//! Every place stands once as itself. Wherever an instruction touches a bit, or jumps, there is a grey copy of the place.

use super::block::{Block, LABEL_GAP, Widths};
use super::control::Control;
use super::picture::{Anchor, At, Picture, PlaceStyle};
use super::svg::{RADIUS, width};
use petril_check::translate::{Part, PlaceRole, System, TransitionRole};
use petril_net::net::{PlaceId, TransitionId};

/// Room around the picture.
const MARGIN: f64 = 24.0;
/// Room between two columns.
const GUTTER: f64 = 40.0;
/// Room for a heading and the space around it.
const HEADING: f64 = 64.0;
/// Room between two steps of which the second does not follow the first.
const BREAK: f64 = 48.0;
/// Distance between bits.
const BIT_PITCH: f64 = 30.0;
/// Approximate ratio of the picture's width to its height.
const ASPECT: f64 = 1.4;

/// Legend of the picture.
const LEGEND: &str = "A grey place is drawn elsewhere too. An arc that ends in a black circle reads: the token stays.";

/// A piece of a column.
struct Piece<'a> {
    heading: Option<&'a str>,
    content: Content<'a>,
}

enum Content<'a> {
    /// A control place, the transitions that take the token from it, and the places they put it on.
    Step { block: Block<'a>, own: PlaceId, next: PlaceId, text: String },
    /// A component of the plant.
    Component(Block<'a>),
    /// The two places of a bit.
    Bit([PlaceId; 2]),
}

/// Draws the net of a system.
#[must_use]
pub fn diagram(system: &System) -> Picture {
    let steps = steps(system, |_| true);
    let pieces: Vec<Piece<'_>> = steps.into_iter().chain(components(system)).chain(bits(system)).collect();
    let title =
        format!("{}: {} places, {} transitions", system.net.name(), system.places.len(), system.transitions.len());
    sheet(system, &pieces, &title)
}

/// Draws everything but the program: the PLC's cycle and each component of the plant, without titles in the pictures.
#[must_use]
pub fn surroundings(system: &System) -> Vec<Picture> {
    let end = system.program.end();
    let cycle = steps(system, |role| role == PlaceRole::Line(end) || role.part() == Part::System);
    let mut pictures = vec![untitled(system, &cycle, "PLC cycle")];
    for mut component in components(system) {
        let name = component.heading.take().unwrap_or_default();
        pictures.push(untitled(system, &[component], name));
    }
    pictures
}

/// Draws the subnet of a line of flat code that takes several steps.
pub fn line(system: &System, line: usize, title: &str) -> Picture {
    let is_in_line = |role| match role {
        PlaceRole::Line(own) | PlaceRole::Within(own, _) | PlaceRole::Hazard(own, _) => own == line,
        _ => false,
    };
    sheet(system, &steps(system, is_in_line), title)
}

/// Draws pieces in columns, below a title and a legend.
fn sheet(system: &System, pieces: &[Piece<'_>], title: &str) -> Picture {
    let mut sheet = Picture::default();
    sheet.text(At { x: MARGIN, y: MARGIN }, Anchor::Start, title, true);
    sheet.text(At { x: MARGIN, y: MARGIN + 18.0 }, Anchor::Start, LEGEND, false);
    let (right, bottom) = fill(system, &mut sheet, pieces, MARGIN + 56.0);
    let right = right.max(MARGIN + width(LEGEND).max(width(title)));
    sheet.finish(right + MARGIN, bottom + RADIUS + MARGIN, title)
}

/// Draws pieces in columns without a title or a legend in the picture.
fn untitled(system: &System, pieces: &[Piece<'_>], title: &str) -> Picture {
    let mut sheet = Picture::default();
    let (right, bottom) = fill(system, &mut sheet, pieces, MARGIN + RADIUS);
    sheet.finish(right + MARGIN, bottom + RADIUS + MARGIN, title)
}

/// Draws pieces in columns, and returns their right and lower edge.
fn fill(system: &System, sheet: &mut Picture, pieces: &[Piece<'_>], top: f64) -> (f64, f64) {
    let (mut x, mut bottom) = (MARGIN, top);
    for column in columns(system, pieces) {
        let widths = column.iter().map(|piece| piece.widths(system)).fold(Widths::default(), Widths::max);
        let mut y = top;
        for (i, piece) in column.iter().enumerate() {
            let below = column.get(i + 1).copied();
            piece.draw(system, sheet, At { x, y }, widths, below);
            y += piece.height() + if below.is_some_and(|below| piece.ends_before(below)) { BREAK } else { 0.0 };
        }
        x += widths.total() + GUTTER;
        bottom = bottom.max(y);
    }
    (x - GUTTER, bottom)
}

/// Steps of the wanted control places, in order.
fn steps(system: &System, wanted: impl Fn(PlaceRole) -> bool) -> Vec<Piece<'_>> {
    let control = Control::of(system);
    let places = control.places();
    let rows = places.iter().enumerate().filter(|(_, own)| wanted(system.places[own.index()]));
    let steps = rows.map(|(row, &own)| {
        let transitions = control.transitions(row);
        let next = places[(row + 1) % places.len()];
        let text = match system.places[own.index()] {
            PlaceRole::Line(line) => system.program.code.get(line).map(|code| system.program.text(code.instruction)),
            _ => None,
        };
        let arcs = transitions.iter().flat_map(|&id| system.net.arcs(id).produce);
        let mut targets: Vec<PlaceId> = arcs.copied().filter(|&place| control.of_place(place).is_some()).collect();
        targets.sort_unstable();
        targets.dedup();
        targets.retain(|&place| place != own && place != next);
        let left = [own].into_iter().chain(targets).chain([next]).collect();
        let block = Block::new(system, left, transitions);
        Piece { heading: None, content: Content::Step { block, own, next, text: text.unwrap_or_default() } }
    });
    steps.collect()
}

fn components(system: &System) -> Vec<Piece<'_>> {
    let count = system.plant.components.len();
    let mut nodes: Vec<(Vec<PlaceId>, Vec<TransitionId>)> = vec![Default::default(); count];
    for id in system.net.place_ids() {
        if let PlaceRole::Plant(component) = system.places[id.index()] {
            nodes[component].0.push(id);
        }
    }
    for id in system.net.transition_ids() {
        if let TransitionRole::Plant { component, .. } = system.transitions[id.index()] {
            nodes[component].1.push(id);
        }
    }
    let components = nodes.into_iter().zip(&system.plant.components).map(|((places, transitions), component)| Piece {
        heading: Some(component.name.as_str()),
        content: Content::Component(Block::new(system, places, &transitions)),
    });
    components.collect()
}

fn bits(system: &System) -> Vec<Piece<'_>> {
    let places = system.net.place_ids().filter(|place| system.places[place.index()].is_bit());
    let places: Vec<PlaceId> = places.collect();
    let pairs = places.chunks_exact(2).enumerate();
    let pieces = pairs.map(|(i, pair)| Piece {
        heading: (i == 0).then_some("current result and variables"),
        content: Content::Bit([pair[0], pair[1]]),
    });
    pieces.collect()
}

/// Cuts the pieces into columns of about the same height, so that the picture is a bit wider than high.
fn columns<'p, 'a>(system: &System, pieces: &'p [Piece<'a>]) -> Vec<Vec<&'p Piece<'a>>> {
    let total: f64 = pieces.iter().map(Piece::height).sum();
    let width = pieces.iter().map(|piece| piece.widths(system)).fold(Widths::default(), Widths::max).total() + GUTTER;
    let count = (ASPECT * total / width).sqrt().round().max(1.0);
    let limit = total / count;
    let mut columns = vec![Vec::new()];
    let mut height = 0.0;
    for piece in pieces {
        if height + piece.height() / 2.0 > limit && columns.len() < count as usize {
            columns.push(Vec::new());
            height = 0.0;
        }
        height += piece.height();
        if let Some(column) = columns.last_mut() {
            column.push(piece);
        }
    }
    columns
}

impl Piece<'_> {
    fn height(&self) -> f64 {
        let content = match &self.content {
            Content::Step { block, .. } | Content::Component(block) => block.height(),
            Content::Bit(_) => BIT_PITCH,
        };
        self.heading.map_or(0.0, |_| HEADING) + content
    }

    /// Whether the piece is the step that begins at a control place.
    fn is_step_of(&self, place: PlaceId) -> bool {
        matches!(&self.content, Content::Step { own, .. } if *own == place)
    }

    /// Whether both pieces are steps and the token does not go from this one to the one below.
    fn ends_before(&self, below: &Self) -> bool {
        match (&self.content, &below.content) {
            (Content::Step { next, .. }, Content::Step { .. }) => !below.is_step_of(*next),
            _ => false,
        }
    }

    fn widths(&self, system: &System) -> Widths {
        match &self.content {
            Content::Step { block, text, .. } => block.widths().max(Widths { left: width(text), ..Widths::default() }),
            Content::Component(block) => block.widths(),
            Content::Bit([zero, _]) => Widths { left: width(system.net.place(*zero).name), ..Widths::default() },
        }
    }

    /// Draws the piece; `below` is the next piece of the column.
    fn draw(&self, system: &System, sheet: &mut Picture, mut at: At, widths: Widths, below: Option<&Piece<'_>>) {
        if let Some(heading) = self.heading {
            sheet.text(At { x: at.x, y: at.y + 38.0 }, Anchor::Start, heading, true);
            at.y += HEADING;
        }
        match &self.content {
            Content::Step { block, own, next, text } => {
                let next_follows = below.is_some_and(|below| below.is_step_of(*next));
                block.draw(sheet, at, widths, |place| match place {
                    _ if place == *own => Some(PlaceStyle::Own),
                    _ if place == *next && (next_follows || !block.touches(place)) => None,
                    _ => Some(PlaceStyle::Copy),
                });
                let below_name = At { x: at.x + widths.left, y: at.y + 14.0 };
                sheet.text(below_name, Anchor::End, text, true);
            }
            Content::Component(block) => block.draw(sheet, at, widths, |place| {
                let is_its_own = matches!(system.places[place.index()], PlaceRole::Plant(_) | PlaceRole::Blocking(_));
                Some(if is_its_own { PlaceStyle::Own } else { PlaceStyle::Copy })
            }),
            Content::Bit(places) => {
                let centre = at.x + widths.left + LABEL_GAP + RADIUS;
                let sides = [(centre, Anchor::End, -1.0), (centre + 3.0 * RADIUS, Anchor::Start, 1.0)];
                for (&id, (x, anchor, direction)) in places.iter().zip(sides) {
                    let place = system.net.place(id);
                    sheet.place(At { x, y: at.y }, PlaceStyle::Own, id, place.is_marked());
                    let label = At { x: x + direction * (RADIUS + LABEL_GAP), y: at.y };
                    sheet.text(label, anchor, place.name, false);
                }
            }
        }
    }
}
