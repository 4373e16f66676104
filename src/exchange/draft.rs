//! A net as its file has it, before its nodes have ids.

use std::path::Path;

use crate::net::{Builder, Located, PlaceId, Units};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::{ShortSpan, Source, Span};

/// The most tokens a place may begin with, and the greatest weight: sums of many are still numbers.
pub const MAX_COUNT: u64 = 1 << 40;

/// Places and transitions in the order of the file, and the arcs in any.
#[derive(Default)]
pub struct Draft {
    pub places: Vec<DraftPlace>,
    pub transitions: Vec<DraftTransition>,
    arcs: Vec<Arc>,
    /// The places that are used and not declared, by position.
    pub undeclared: Vec<usize>,
    /// The ids of both in the file, if the format has ids.
    pub ids: Option<(Vec<String>, Vec<String>)>,
    pub units: Option<Units>,
    /// What no safe net has.
    pub not_safe: Vec<Diagnostic>,
    pub warnings: Vec<Diagnostic>,
}

pub struct DraftPlace {
    pub name: String,
    pub span: Span,
    pub tokens: u64,
}

pub struct DraftTransition {
    pub name: String,
    pub span: Span,
}

/// What an arc does to its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Direction {
    Consume,
    Produce,
    Read,
}

/// An arc, in little memory: a file may have millions.
#[derive(Clone, Copy)]
struct Arc {
    transition: u32,
    place: u32,
    weight: u64,
    span: ShortSpan,
    direction: Direction,
}

impl Draft {
    /// Notes something that no safe net has.
    pub fn refuse(&mut self, span: Span, message: String, help: &str) {
        self.not_safe.push(Diagnostic::new(Code::NetNotOrdinary, span, message).help(help));
    }

    /// Adds an arc between a transition and a place, both by position.
    pub fn arc(&mut self, transition: usize, direction: Direction, place: usize, weight: u64, span: Span) {
        let (transition, place) = (transition as u32, place as u32);
        self.arcs.push(Arc { transition, place, weight, span: span.into(), direction });
    }

    /// Notes which arcs are drawn twice: together they have the weight 2. The arcs are in order.
    fn parallel_arcs(&mut self) {
        let key = |arc: &Arc| (arc.transition, arc.direction, arc.place);
        for pair in self.arcs.windows(2).filter(|pair| key(&pair[0]) == key(&pair[1])) {
            let (place, transition) =
                (&self.places[pair[0].place as usize].name, &self.transitions[pair[0].transition as usize].name);
            let message = format!("two arcs join `{place}` and `{transition}` in the same direction");
            self.not_safe.push(
                Diagnostic::new(Code::NetNotOrdinary, pair[1].span.into(), message)
                    .here("this makes a weight of 2")
                    .also(pair[0].span.into(), "the first is here")
                    .help("leave one of them: in a safe net every arc has weight 1"),
            );
        }
    }

    /// The net, with the spans of its nodes, unless there are errors.
    pub fn finish(mut self, name: impl FnOnce() -> String, errors: Vec<Diagnostic>) -> Result<Located, Trouble> {
        self.arcs.sort_unstable_by_key(|arc| (arc.transition, arc.direction, arc.place, arc.span));
        self.parallel_arcs();
        if !errors.is_empty() {
            return Err(Trouble { errors, not_safe: self.not_safe });
        }
        self.not_safe.sort_by_key(Diagnostic::span);
        self.warnings.sort_by_key(Diagnostic::span);
        let mut builder = Builder::new(name());
        for place in &self.places {
            builder.place_with(&place.name, place.tokens);
        }
        let mut arcs = self.arcs.iter().peekable();
        let mut lists: [Vec<(PlaceId, u64)>; 3] = Default::default();
        for (position, transition) in self.transitions.iter().enumerate() {
            lists.iter_mut().for_each(Vec::clear);
            while let Some(arc) = arcs.next_if(|arc| arc.transition as usize == position) {
                lists[arc.direction as usize].push((PlaceId::at(arc.place as usize), arc.weight));
            }
            let [consume, produce, read] = &lists;
            builder.weighted(&transition.name, consume, produce, read);
        }
        Ok(Located {
            net: builder.build(),
            places: self.places.iter().map(|place| place.span).collect(),
            transitions: self.transitions.iter().map(|transition| transition.span).collect(),
            undeclared: self.undeclared.into_iter().map(PlaceId::at).collect(),
            ids: self.ids,
            units: self.units,
            not_safe: self.not_safe,
            warnings: self.warnings,
        })
    }
}

/// Why a file holds no net.
pub struct Trouble {
    errors: Vec<Diagnostic>,
    /// What no safe net has, as far as the file could be read.
    not_safe: Vec<Diagnostic>,
}

impl From<Vec<Diagnostic>> for Trouble {
    fn from(errors: Vec<Diagnostic>) -> Self {
        Self { errors, not_safe: Vec::new() }
    }
}

impl Trouble {
    /// The errors, in the order of the text.
    pub fn errors(mut self) -> Vec<Diagnostic> {
        self.errors.sort_by_key(Diagnostic::span);
        self.errors
    }

    /// These, and what no safe net has.
    pub fn all(mut self) -> Vec<Diagnostic> {
        self.errors.append(&mut self.not_safe);
        self.errors()
    }
}

/// The name of a net whose file gives it none: the file's, without folder and extension.
pub fn file_stem(source: &Source) -> String {
    let stem = Path::new(source.name()).file_stem();
    stem.map_or_else(|| source.name().to_owned(), |stem| stem.to_string_lossy().into_owned())
}
