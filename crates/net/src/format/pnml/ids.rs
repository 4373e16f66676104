//! Table of ids. Each is unique in its document.

use std::hash::{BuildHasher, RandomState};

use hashbrown::HashTable;

use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::{ShortSpan, Source, Span};
use petril_base::xml::{Piece, attribute_at};

/// Ids of a document, stored as positions in the text: there may be millions.
pub struct Ids<'s> {
    source: &'s Source,
    /// Each id with its item; `None` for elements that cannot be referred to: the net itself, pages, arcs.
    entries: Vec<(ShortSpan, Option<u32>)>,
    /// Positions in `entries`, hashed by text.
    table: HashTable<u32>,
    hasher: RandomState,
}

impl<'s> Ids<'s> {
    pub fn of(source: &'s Source) -> Self {
        Self { source, entries: Vec::new(), table: HashTable::new(), hasher: RandomState::new() }
    }

    /// Declares an id, or reports a duplicate.
    pub fn declare(&mut self, id: &Piece<'s>, item: Option<usize>, diagnostics: &mut Vec<Diagnostic>) {
        if let Some(entry) = self.entry(&id.text) {
            let message = format!("the id `{}` is given twice", id.text);
            diagnostics.push(
                Diagnostic::new(Code::NetReference, id.span, message)
                    .here("given again")
                    .also(self.entries[entry].0.into(), "first given here"),
            );
            return;
        }
        let position = self.entries.len() as u32;
        self.entries.push((id.span.into(), item.map(|item| item as u32)));
        let Self { source, entries, table, hasher } = self;
        let hash = |&entry: &u32| hasher.hash_one(text(source, entries[entry as usize].0).as_ref());
        table.insert_unique(hash(&position), position, hash);
    }

    /// Item of an id; `Some(None)` if the id belongs to an element that cannot be referred to.
    pub fn find(&self, id: &str) -> Option<Option<usize>> {
        self.entry(id).map(|entry| self.entries[entry].1.map(|item| item as usize))
    }

    fn entry(&self, id: &str) -> Option<usize> {
        let is_same = |&entry: &u32| text(self.source, self.entries[entry as usize].0) == id;
        self.table.find(self.hasher.hash_one(id), is_same).map(|&entry| entry as usize)
    }
}

fn text(source: &Source, span: ShortSpan) -> std::borrow::Cow<'_, str> {
    attribute_at(source, Span::from(span))
}
