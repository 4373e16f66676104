//! A net as its file has it, before its nodes have ids.

use std::path::Path;

use crate::diagnostic::{Code, Diagnostic};
use crate::net::{Builder, Located, PlaceId};
use crate::source::{Source, Span};

/// The most tokens a place may begin with, and the greatest weight: sums of many are still numbers.
pub const MAX_COUNT: u64 = 1 << 40;

/// Places and transitions in the order of the file. Arcs name places by position.
#[derive(Default)]
pub struct Draft {
    pub places: Vec<DraftPlace>,
    pub transitions: Vec<DraftTransition>,
    /// The ids of both in the file, if the format has ids.
    pub ids: Option<(Vec<String>, Vec<String>)>,
    /// What no safe net has.
    pub not_safe: Vec<Diagnostic>,
}

pub struct DraftPlace {
    pub name: String,
    pub span: Span,
    pub tokens: u64,
}

pub struct DraftTransition {
    pub name: String,
    pub span: Span,
    pub consume: Vec<Arc>,
    pub produce: Vec<Arc>,
    pub read: Vec<Arc>,
}

/// One end of an arc: a place, the arc's weight, and where it stands.
#[derive(Clone, Copy)]
pub struct Arc {
    pub place: usize,
    pub weight: u64,
    pub span: Span,
}

impl DraftTransition {
    /// A transition without arcs.
    pub fn new(name: String, span: Span) -> Self {
        Self { name, span, consume: Vec::new(), produce: Vec::new(), read: Vec::new() }
    }
}

impl Draft {
    /// Notes something that no safe net has.
    pub fn refuse(&mut self, span: Span, message: String, help: &str) {
        self.not_safe.push(Diagnostic::new(Code::NetNotOrdinary, span, message).help(help));
    }

    /// Notes which arcs are drawn twice: together they have the weight 2.
    fn parallel_arcs(&mut self) {
        for transition in &self.transitions {
            for list in [&transition.consume, &transition.produce, &transition.read] {
                let mut sorted = list.clone();
                sorted.sort_by_key(|arc| (arc.place, arc.span));
                for pair in sorted.windows(2).filter(|pair| pair[0].place == pair[1].place) {
                    let place = &self.places[pair[0].place].name;
                    let message = format!("two arcs join `{place}` and `{}` in the same direction", transition.name);
                    self.not_safe.push(
                        Diagnostic::new(Code::NetNotOrdinary, pair[1].span, message)
                            .here("this makes a weight of 2")
                            .also(pair[0].span, "the first is here")
                            .help("leave one of them: in a safe net every arc has weight 1"),
                    );
                }
            }
        }
    }

    /// The net, with the spans of its nodes, unless there are errors.
    pub fn finish(mut self, name: impl FnOnce() -> String, errors: Vec<Diagnostic>) -> Result<Located, Trouble> {
        self.parallel_arcs();
        if !errors.is_empty() {
            return Err(Trouble { errors, not_safe: self.not_safe });
        }
        self.not_safe.sort_by_key(Diagnostic::span);
        let name = name();
        let mut builder = Builder::new(name);
        let places: Vec<PlaceId> =
            self.places.iter().map(|place| builder.place_with(&place.name, place.tokens)).collect();
        let arcs =
            |list: &[Arc]| -> Vec<(PlaceId, u64)> { list.iter().map(|arc| (places[arc.place], arc.weight)).collect() };
        for DraftTransition { name, consume, produce, read, .. } in &self.transitions {
            builder.weighted(name, &arcs(consume), &arcs(produce), &arcs(read));
        }
        Ok(Located {
            net: builder.build(),
            places: self.places.iter().map(|place| place.span).collect(),
            transitions: self.transitions.iter().map(|transition| transition.span).collect(),
            ids: self.ids,
            not_safe: self.not_safe,
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
