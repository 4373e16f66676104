//! A block: transitions in a column, control places to their left, every other place they touch to their right.

use std::collections::BTreeMap;

use super::crossings::{self, Columns};
use super::picture::{Anchor, At, DrawnArc, Head, Picture, PlaceStyle};
use super::svg::{BOX_HEIGHT, RADIUS, width};
use petril_check::translate::{System, TransitionRole};
use petril_net::net::{PlaceId, TransitionId};

/// Room between two columns, for the arcs.
const GAP: f64 = 84.0;
/// Height of a transition with the room around it.
const TRANSITION_PITCH: f64 = 34.0;
/// Height of a place on the right with the room around it.
const PLACE_PITCH: f64 = 34.0;
/// Minimum distance between places on the left.
const CONTROL_PITCH: f64 = 48.0;
/// Room above and below the middle and the right column.
const PADDING: f64 = 7.0;
/// Room between a place and its name.
pub const LABEL_GAP: f64 = 6.0;
/// Distance between arcs at the side of a transition.
const PORT_PITCH: f64 = 8.0;

/// A block with its nodes ordered but not yet placed.
pub struct Block<'a> {
    system: &'a System,
    /// Places of the left column from top to bottom; the first at the upper edge, the last at the lower.
    left: Vec<PlaceId>,
    middle: Vec<TransitionId>,
    right: Vec<PlaceId>,
}

/// Widths of a block's columns.
#[derive(Clone, Copy, Debug, Default)]
pub struct Widths {
    /// Width of the names of the places on the left.
    pub left: f64,
    /// Width of the transitions' boxes.
    pub middle: f64,
    /// Width of the names of the places on the right; 0 if there are none.
    pub right: f64,
}

impl Widths {
    /// Widths large enough for both, column by column.
    pub fn max(self, other: Self) -> Self {
        Self {
            left: self.left.max(other.left),
            middle: self.middle.max(other.middle),
            right: self.right.max(other.right),
        }
    }

    /// Centres of the columns, as distances from the left edge of the block.
    fn columns(self) -> [f64; 3] {
        let left = self.left + LABEL_GAP + RADIUS;
        let middle = left + RADIUS + GAP + self.middle / 2.0;
        [left, middle, middle + self.middle / 2.0 + GAP + RADIUS]
    }

    /// Width of the whole block.
    pub fn total(self) -> f64 {
        let [_, middle, right] = self.columns();
        if self.right > 0.0 { right + RADIUS + LABEL_GAP + self.right } else { middle + self.middle / 2.0 }
    }
}

impl<'a> Block<'a> {
    /// Orders the nodes so that few arcs cross.
    pub fn new(system: &'a System, left: Vec<PlaceId>, transitions: &[TransitionId]) -> Self {
        let mut right: Vec<PlaceId> = Vec::new();
        let mut seats = BTreeMap::new();
        let is_left: BTreeMap<PlaceId, usize> = left.iter().enumerate().map(|(i, &place)| (place, i)).collect();
        let mut columns = Columns { left: Vec::new(), right: Vec::new(), right_count: 0 };
        for &transition in transitions {
            let (mut to_left, mut to_right) = (Vec::new(), Vec::new());
            for (place, _) in arcs(system, transition) {
                match is_left.get(&place) {
                    Some(&seat) => to_left.push(seat),
                    None => to_right.push(*seats.entry(place).or_insert_with(|| {
                        right.push(place);
                        right.len() - 1
                    })),
                }
            }
            columns.left.push(to_left);
            columns.right.push(to_right);
        }
        columns.right_count = right.len();
        let (middle, order) = crossings::order(&columns);
        let middle = middle.into_iter().map(|i| transitions[i]).collect();
        let right = order.into_iter().map(|i| right[i]).collect();
        Self { system, left, middle, right }
    }

    /// Widths that the columns need.
    pub fn widths(&self) -> Widths {
        let name = |place: &PlaceId| width(self.system.net.place(*place).name);
        let widest = |widths: &mut dyn Iterator<Item = f64>| widths.fold(0.0, f64::max);
        Widths {
            left: widest(&mut self.left.iter().map(name)),
            middle: widest(&mut self.middle.iter().map(|&id| width(&caption(self.system, id)) + 12.0)).max(24.0),
            right: widest(&mut self.right.iter().map(name)),
        }
    }

    /// Height of the block: the distance between the first and the last place on the left.
    pub fn height(&self) -> f64 {
        let left = CONTROL_PITCH * self.left.len().saturating_sub(1) as f64;
        let middle = TRANSITION_PITCH * self.middle.len() as f64;
        left.max(middle).max(PLACE_PITCH * self.right.len() as f64) + 2.0 * PADDING
    }

    /// Whether a transition of the block has an arc from or to a place.
    pub fn touches(&self, place: PlaceId) -> bool {
        self.middle.iter().any(|&id| arcs(self.system, id).any(|(touched, _)| touched == place))
    }

    /// Draws the block with its upper left corner at `at`. `style` says how a place is drawn, if at all.
    pub fn draw(&self, sheet: &mut Picture, at: At, widths: Widths, style: impl Fn(PlaceId) -> Option<PlaceStyle>) {
        let net = &self.system.net;
        let height = self.height();
        let columns = widths.columns().map(|x| at.x + x);
        let spread = |i: usize, n: usize| at.y + PADDING + (height - 2.0 * PADDING) * (i as f64 + 0.5) / n as f64;
        let mut positions = BTreeMap::new();
        for (i, &place) in self.left.iter().enumerate() {
            let share = if self.left.len() == 1 { 0.5 } else { i as f64 / (self.left.len() - 1) as f64 };
            let y = at.y + height * share;
            positions.insert(place, At { x: columns[0], y });
        }
        for (i, &place) in self.right.iter().enumerate() {
            positions.insert(place, At { x: columns[2], y: spread(i, self.right.len()) });
        }
        for (i, &id) in self.middle.iter().enumerate() {
            let centre = At { x: columns[1], y: spread(i, self.middle.len()) };
            sheet.transition(id, centre, widths.middle, &caption(self.system, id));
            self.draw_arcs(sheet, id, centre, widths.middle / 2.0, &positions);
        }
        let sides = [(&self.left, Anchor::End, -1.0), (&self.right, Anchor::Start, 1.0)];
        for (places, anchor, direction) in sides {
            for place in places {
                let Some(style) = style(*place) else { continue };
                let at = positions[place];
                sheet.place(at, style, *place, net.place(*place).is_marked());
                let label = At { x: at.x + direction * (RADIUS + LABEL_GAP), y: at.y };
                sheet.text(label, anchor, net.place(*place).name, false);
            }
        }
    }

    /// The arcs of a transition, straight from its side to the places; higher places get higher ports.
    fn draw_arcs(
        &self,
        sheet: &mut Picture,
        id: TransitionId,
        centre: At,
        half_width: f64,
        positions: &BTreeMap<PlaceId, At>,
    ) {
        for side in [-1.0, 1.0] {
            let here = arcs(self.system, id).filter(|(place, _)| (positions[place].x - centre.x) * side > 0.0);
            let mut here: Vec<(At, Arc)> = here.map(|(place, arc)| (positions[&place], arc)).collect();
            here.sort_by(|a, b| a.0.y.total_cmp(&b.0.y));
            let pitch = PORT_PITCH.min((BOX_HEIGHT - 6.0) / here.len() as f64);
            for (i, &(place, arc)) in here.iter().enumerate() {
                let shift = pitch * (i as f64 - (here.len() - 1) as f64 / 2.0);
                let port = At { x: centre.x + side * half_width, y: centre.y + shift };
                let rim = rim(place, port);
                let (from, to, head) = match arc {
                    Arc::Consume => (rim, port, Head::Arrow),
                    Arc::Read => (rim, port, Head::Dot),
                    Arc::Produce => (port, rim, Head::Arrow),
                };
                sheet.arcs.push(DrawnArc { transition: id, from, to, head });
            }
        }
    }
}

/// Kind of an arc.
#[derive(Clone, Copy)]
enum Arc {
    Consume,
    Produce,
    Read,
}

/// The arcs of a transition.
fn arcs(system: &System, id: TransitionId) -> impl Iterator<Item = (PlaceId, Arc)> {
    let arcs = system.net.arcs(id);
    let lists = [(arcs.consume, Arc::Consume), (arcs.read, Arc::Read), (arcs.produce, Arc::Produce)];
    lists.into_iter().flat_map(|(places, arc)| places.iter().map(move |&place| (place, arc)))
}

/// The point of a place's circle that is nearest to `port`.
fn rim(place: At, port: At) -> At {
    let (dx, dy) = (port.x - place.x, port.y - place.y);
    let scale = RADIUS / dx.hypot(dy);
    At { x: place.x + dx * scale, y: place.y + dy * scale }
}

/// Text in the box of a transition: the values under which it fires. The rest of the name says where the transition
/// belongs, which the picture shows.
fn caption(system: &System, id: TransitionId) -> String {
    let name = system.net.transition(id).name;
    let inside = name.split_once('[').map_or("", |(_, rest)| rest.strip_suffix(']').unwrap_or(rest));
    match system.transitions[id.index()] {
        TransitionRole::Line(_) => inside.to_owned(),
        TransitionRole::Copy { .. } => inside.split(" from ").next().unwrap_or_default().replace("->", "→"),
        TransitionRole::Block | TransitionRole::Unblock | TransitionRole::Plant { .. } => name.to_owned(),
    }
}
