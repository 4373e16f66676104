//! Net under construction, as read from a file, before its nodes have ids.

use std::path::Path;

use crate::net::{Builder, Located, PlaceId, Units};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::{ShortSpan, Source, Span};

/// Upper bound on initial tokens and on weights, so that sums of many still fit.
pub const MAX_COUNT: u64 = 1 << 40;

/// Places and transitions in file order, and arcs in any order.
#[derive(Default)]
pub struct Draft {
    pub places: Vec<DraftPlace>,
    pub transitions: Vec<DraftTransition>,
    arcs: Vec<Arc>,
    /// Places that are used but not declared, by position.
    pub undeclared: Vec<usize>,
    /// Ids of places and transitions in the file, if the format has ids.
    pub ids: Option<(Vec<String>, Vec<String>)>,
    pub units: Option<Units>,
    /// Diagnostics of what a safe net cannot have.
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

/// Effect of an arc on its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Direction {
    Consume,
    Produce,
    Read,
}

/// Arc in a compact form: a file may have millions.
#[derive(Clone, Copy)]
struct Arc {
    transition: u32,
    place: u32,
    weight: u64,
    span: ShortSpan,
    direction: Direction,
}

impl Draft {
    /// Records something that a safe net cannot have.
    pub fn refuse(&mut self, span: Span, message: String, help: &str) {
        self.not_safe.push(Diagnostic::new(Code::NetNotOrdinary, span, message).help(help));
    }

    /// Adds an arc between a transition and a place, both by position.
    pub fn arc(&mut self, transition: usize, direction: Direction, place: usize, weight: u64, span: Span) {
        let (transition, place) = (transition as u32, place as u32);
        self.arcs.push(Arc { transition, place, weight, span: span.into(), direction });
    }

    /// Reports parallel arcs: together they have weight 2. The arcs are sorted.
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

    /// Builds the net, with the spans of its nodes, unless there are errors.
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

/// Diagnostics of a file that contains no valid net.
pub struct Trouble {
    errors: Vec<Diagnostic>,
    /// Diagnostics of what a safe net cannot have, as far as the file could be read.
    not_safe: Vec<Diagnostic>,
}

impl From<Vec<Diagnostic>> for Trouble {
    fn from(errors: Vec<Diagnostic>) -> Self {
        Self { errors, not_safe: Vec::new() }
    }
}

impl Trouble {
    /// Errors, in the order of the text.
    pub fn errors(mut self) -> Vec<Diagnostic> {
        self.errors.sort_by_key(Diagnostic::span);
        self.errors
    }

    /// Errors, and what a safe net cannot have.
    pub fn all(mut self) -> Vec<Diagnostic> {
        self.errors.append(&mut self.not_safe);
        self.errors()
    }
}

/// Default name of a net: its file name without folder and extension.
pub fn file_stem(source: &Source) -> String {
    let stem = Path::new(source.name()).file_stem();
    stem.map_or_else(|| source.name().to_owned(), |stem| stem.to_string_lossy().into_owned())
}
