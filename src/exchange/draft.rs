//! A net as its file has it, before its nodes have ids.

use std::path::Path;

use crate::diagnostic::{Code, Diagnostic};
use crate::net::{Arcs, Builder, Located, PlaceId};
use crate::source::{Source, Span};

/// Places and transitions in the order of the file. Arcs name places by position.
#[derive(Default)]
pub struct Draft {
    pub places: Vec<DraftPlace>,
    pub transitions: Vec<DraftTransition>,
}

pub struct DraftPlace {
    pub name: String,
    pub span: Span,
    pub marked: bool,
}

pub struct DraftTransition {
    pub name: String,
    pub span: Span,
    pub consume: Vec<Arc>,
    pub produce: Vec<Arc>,
    pub read: Vec<Arc>,
}

/// One end of an arc: a place, and where the arc stands.
#[derive(Clone, Copy)]
pub struct Arc {
    pub place: usize,
    pub span: Span,
}

impl DraftTransition {
    /// A transition without arcs.
    pub fn new(name: String, span: Span) -> Self {
        Self { name, span, consume: Vec::new(), produce: Vec::new(), read: Vec::new() }
    }
}

impl Draft {
    /// Says which arcs are drawn twice: together they have the weight 2.
    pub fn parallel_arcs(&self, diagnostics: &mut Vec<Diagnostic>) {
        for transition in &self.transitions {
            for list in [&transition.consume, &transition.produce, &transition.read] {
                let mut sorted = list.clone();
                sorted.sort_by_key(|arc| (arc.place, arc.span));
                for pair in sorted.windows(2).filter(|pair| pair[0].place == pair[1].place) {
                    let place = &self.places[pair[0].place].name;
                    let message = format!("two arcs join `{place}` and `{}` in the same direction", transition.name);
                    diagnostics.push(
                        Diagnostic::new(Code::NetNotOrdinary, pair[1].span, message)
                            .here("this makes a weight of 2")
                            .also(pair[0].span, "the first is here")
                            .help("leave one of them: in a safe net every arc has weight 1"),
                    );
                }
            }
        }
    }

    /// The net, with the spans of its nodes.
    pub fn finish(self, name: String) -> Located {
        let mut builder = Builder::new(name);
        let spans = self.places.iter().map(|place| place.span).collect();
        let places: Vec<PlaceId> =
            self.places.into_iter().map(|place| builder.place(place.name, place.marked)).collect();
        let ids = |arcs: &[Arc]| arcs.iter().map(|arc| places[arc.place]).collect::<Vec<PlaceId>>();
        let transitions = self.transitions.iter().map(|transition| transition.span).collect();
        for transition in self.transitions {
            let DraftTransition { name, consume, produce, read, .. } = transition;
            builder.transition(name, Arcs { consume: &ids(&consume), produce: &ids(&produce), read: &ids(&read) });
        }
        Located { net: builder.build(), places: spans, transitions }
    }
}

/// The name of a net whose file gives it none: the file's, without folder and extension.
pub fn file_stem(source: &Source) -> String {
    let stem = Path::new(source.name()).file_stem();
    stem.map_or_else(|| source.name().to_owned(), |stem| stem.to_string_lossy().into_owned())
}
