//! Entry point of the reader: text to net, or all errors.

use std::collections::HashMap;

use pest::Parser;
use pest::iterators::Pair;
use pest_derive::Parser;

use super::consume::{self, Declaration, Name};
use super::expected;
use crate::format::draft::{Draft, DraftPlace, DraftTransition, Trouble, file_stem};
use crate::net::Located;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::{Source, Span};

#[derive(Parser)]
#[grammar = "../../grammar/tina.pest"]
pub(super) struct TinaParser;

/// Reads a net. Places are numbered by first appearance, transitions by definition; a net without a `net` line is named
/// after its file.
///
/// # Errors
/// A line cannot be parsed, a node is defined twice, or the net has what a place/transition net does not have:
/// inhibitor and stopwatch arcs, time, priorities.
pub fn read(source: &Source) -> Result<Located, Vec<Diagnostic>> {
    load(source).map_err(Trouble::errors)
}

/// As [`read`], but for a net that may be safe.
///
/// # Errors
/// Weights, or several tokens on a place, too.
pub fn read_safe(source: &Source) -> Result<Located, Vec<Diagnostic>> {
    load(source).map_err(Trouble::all).and_then(Located::safe)
}

fn load(source: &Source) -> Result<Located, Trouble> {
    let mut diagnostics = Vec::new();
    let mut assembly = Assembly::default();
    match TinaParser::parse(Rule::file, source.text()) {
        Ok(file) => {
            for line in file.flat_map(Pair::into_inner) {
                if let Some(declaration) = consume::declaration(line, &mut assembly.draft, &mut diagnostics) {
                    assembly.add(declaration, &mut diagnostics);
                }
            }
        }
        // The grammar accepts any text, so the error is a limit of the parser itself.
        Err(error) => diagnostics.push(expected::diagnostic(&error, source.text(), 0)),
    }
    let is_undeclared = |&place: &usize| assembly.declared[place].is_none();
    assembly.draft.undeclared = (0..assembly.draft.places.len()).filter(is_undeclared).collect();
    let name = assembly.name.map(|name| name.text);
    assembly.draft.finish(|| name.unwrap_or_else(|| file_stem(source)), diagnostics)
}

/// Net under construction, with its names.
#[derive(Default)]
struct Assembly {
    name: Option<Name>,
    draft: Draft,
    places: HashMap<String, usize>,
    /// Declaration of each place, if found so far.
    declared: Vec<Option<Span>>,
    transitions: HashMap<String, Span>,
}

impl Assembly {
    fn add(&mut self, declaration: Declaration, diagnostics: &mut Vec<Diagnostic>) {
        match declaration {
            Declaration::Net(name) => match &self.name {
                None => self.name = Some(name),
                Some(first) => diagnostics.push(
                    Diagnostic::new(Code::NetSyntax, name.span, "this net is named a second time")
                        .also(first.span, "first named here")
                        .help("put each net in a file of its own"),
                ),
            },
            Declaration::Place { name, tokens } => self.declare(name, tokens, diagnostics),
            Declaration::Transition { name: Name { text, span }, arcs } => {
                let first = *self.transitions.entry(text.clone()).or_insert(span);
                if first != span {
                    diagnostics.push(twice("transition", &text, span, first));
                }
                let transition = self.draft.transitions.len();
                self.draft.transitions.push(DraftTransition { name: text, span });
                for (direction, place, weight) in arcs {
                    let span = place.span;
                    let place = self.place(place);
                    self.draft.arc(transition, direction, place, weight, span);
                }
            }
        }
    }

    fn declare(&mut self, name: Name, tokens: u64, diagnostics: &mut Vec<Diagnostic>) {
        if let Some(&place) = self.places.get(&name.text)
            && let Some(first) = self.declared[place]
        {
            return diagnostics.push(twice("place", &name.text, name.span, first));
        }
        let span = name.span;
        let place = self.place(name);
        self.declared[place] = Some(span);
        self.draft.places[place].span = span;
        self.draft.places[place].tokens = tokens;
    }

    /// Position of a place by name, possibly new.
    fn place(&mut self, Name { text, span }: Name) -> usize {
        if let Some(&place) = self.places.get(&text) {
            return place;
        }
        self.places.insert(text.clone(), self.draft.places.len());
        self.draft.places.push(DraftPlace { name: text, span, tokens: 0 });
        self.declared.push(None);
        self.draft.places.len() - 1
    }
}

fn twice(kind: &str, name: &str, span: Span, first: Span) -> Diagnostic {
    let message = format!("the {kind} `{name}` is defined twice");
    Diagnostic::new(Code::NetReference, span, message).here("defined again").also(first, "first defined here")
}
