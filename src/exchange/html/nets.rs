//! Nets on which tokens move: the PLC's cycle and the plant, and the subnets of lines executed in some run.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Map, Value, json};

use crate::draw::{Anchor, At, Head, Picture, PlaceStyle, subnet, surroundings};
use petril_check::translate::{System, TransitionRole};
use petril_net::net::{PlaceId, TransitionId};

/// Upper bound on the shapes of a picture; larger ones are unreadable.
const MAX_SHAPES: usize = 2000;
/// Upper bound on the shapes of all pictures.
const MAX_ALL: usize = 40_000;

/// Collector of nodes and pictures. The page contains only what some run needs; nodes are renumbered.
pub struct Nets<'a> {
    system: &'a System,
    places: BTreeMap<PlaceId, usize>,
    place_list: Vec<PlaceId>,
    transitions: BTreeMap<TransitionId, usize>,
    transition_list: Vec<TransitionId>,
    /// Lines whose subnets are needed.
    lines: BTreeSet<usize>,
}

impl<'a> Nets<'a> {
    pub fn new(system: &'a System) -> Self {
        Self {
            system,
            places: BTreeMap::new(),
            place_list: Vec::new(),
            transitions: BTreeMap::new(),
            transition_list: Vec::new(),
            lines: BTreeSet::new(),
        }
    }

    /// Number of a transition.
    pub fn transition(&mut self, transition: TransitionId) -> usize {
        let (list, next) = (&mut self.transition_list, self.transitions.len());
        *self.transitions.entry(transition).or_insert_with(|| {
            list.push(transition);
            next
        })
    }

    fn place(&mut self, place: PlaceId) -> usize {
        let (list, next) = (&mut self.place_list, self.places.len());
        *self.places.entry(place).or_insert_with(|| {
            list.push(place);
            next
        })
    }

    /// Requests the subnet of a line, if tokens move on it.
    pub fn draw(&mut self, line: usize, with_tokens: bool) {
        if with_tokens {
            self.lines.insert(line);
        }
    }

    /// Builds everything requested.
    pub fn finish(mut self) -> Value {
        if self.transition_list.is_empty() {
            return Value::Null;
        }
        let system = self.system;
        let mut room = MAX_ALL;
        let mut shapes = Map::new();
        let around: Vec<Value> = (surroundings(system).iter())
            .map(|picture| json!([picture.title, self.picture(picture, &mut room)]))
            .collect();
        // Subnets that are too large are not laid out: those of multiplications have thousands of transitions.
        let mut sizes = vec![0_usize; system.program.end()];
        for role in &system.transitions {
            if let TransitionRole::Line(line) = *role {
                sizes[line] += 1;
            }
        }
        for line in std::mem::take(&mut self.lines) {
            if sizes[line] < MAX_SHAPES.min(room) {
                let picture = subnet(system, line, None);
                shapes.insert(line.to_string(), self.picture(&picture, &mut room));
            }
        }
        let mut transitions = Vec::new();
        // Places still get numbers here, transitions do not.
        for transition in std::mem::take(&mut self.transition_list) {
            let arcs = system.net.arcs(transition);
            let numbers =
                |nets: &mut Self, places: &[PlaceId]| places.iter().map(|&p| nets.place(p)).collect::<Vec<_>>();
            let (consume, produce) = (numbers(&mut self, arcs.consume), numbers(&mut self, arcs.produce));
            let part = system.transitions[transition.index()].part().name();
            transitions.push(json!([system.net.transition(transition).name, consume, produce, part]));
        }
        let names: Vec<&str> = self.place_list.iter().map(|&place| system.net.place(place).name).collect();
        let is_marked = |&(_, &place): &(usize, &PlaceId)| system.net.place(place).is_marked();
        let marked: Vec<usize> = self.place_list.iter().enumerate().filter(is_marked).map(|(i, _)| i).collect();
        json!({ "places": names, "marked": marked, "transitions": transitions, "around": around, "lines": shapes })
    }

    /// A picture as lists of numbers, positions rounded; null if it is too large.
    fn picture(&mut self, picture: &Picture, room: &mut usize) -> Value {
        let count = picture.places.len() + picture.transitions.len() + picture.arcs.len() + picture.texts.len();
        if count > MAX_SHAPES || count > *room {
            return Value::Null;
        }
        *room -= count;
        let places: Vec<Value> = (picture.places.iter())
            .map(|p| json!([self.place(p.place), round(p.at.x), round(p.at.y), u8::from(p.style == PlaceStyle::Copy)]))
            .collect();
        let transitions: Vec<Value> = (picture.transitions.iter())
            .map(|t| json!([self.transition(t.transition), round(t.at.x), round(t.at.y), round(t.width)]))
            .collect();
        let end = |At { x, y }: At| [round(x), round(y)];
        let arcs: Vec<Value> = (picture.arcs.iter())
            .map(|a| {
                let ([x1, y1], [x2, y2]) = (end(a.from), end(a.to));
                json!([self.transition(a.transition), x1, y1, x2, y2, u8::from(a.head == Head::Dot)])
            })
            .collect();
        let texts: Vec<Value> = (picture.texts.iter())
            .map(|t| {
                let anchor = match t.anchor {
                    Anchor::Start => 0,
                    Anchor::Middle => 1,
                    Anchor::End => 2,
                };
                json!([round(t.at.x), round(t.at.y), anchor, u8::from(t.strong), t.text])
            })
            .collect();
        json!({
            "size": [round(picture.width), round(picture.height)],
            "places": places, "boxes": transitions, "arcs": arcs, "texts": texts,
        })
    }
}

/// Rounds a position to half a unit.
fn round(x: f64) -> Value {
    let halves = (2.0 * x).round();
    if halves % 2.0 == 0.0 { ((halves / 2.0) as i64).into() } else { (halves / 2.0).into() }
}
