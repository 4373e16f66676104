//! The names a program organisation unit declares.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use super::address::{self, Area, Location};
use super::shape::{Shape, Value};
use crate::syntax::ast::key;
use petril_base::source::Span;

/// Where a variable is declared, which says who may write it and how long it lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Section {
    /// `VAR_INPUT`
    Input,
    /// `VAR_OUTPUT`
    Output,
    /// `VAR_IN_OUT`: stands for a variable of the caller.
    InOut,
    /// `VAR`, `VAR_GLOBAL`
    Local,
    /// `VAR_TEMP`: begins anew with every call.
    Temp,
    /// `CONSTANT`
    Constant,
    /// The result of a function.
    Result,
    /// `VAR_EXTERNAL`: stands for the global variable of this position.
    External(usize),
}

/// A declared name.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// As it was declared.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// In which block.
    pub section: Section,
    /// What it is; `None` where that cannot be told, which has been reported.
    pub shape: Option<Shape>,
    /// Its value at power-on.
    pub initial: Value,
    /// Whether a value was written.
    pub is_given: bool,
    /// Its address, if it has one.
    pub location: Option<Location>,
}

impl Symbol {
    /// The area of its address.
    pub fn area(&self) -> Option<Area> {
        self.location.as_ref().map(|location| location.area)
    }
}

/// The declared names, in the order of the text. Of a name declared twice the first declaration counts.
#[derive(Clone, Debug, Default)]
pub struct Symbols {
    list: Vec<Symbol>,
    by_key: BTreeMap<String, usize>,
    by_address: BTreeMap<String, usize>,
}

impl Symbols {
    /// Adds a symbol, unless there is one of this name: then this is its position.
    pub fn add(&mut self, symbol: Symbol) -> Result<(), usize> {
        let position = self.list.len();
        match self.by_key.entry(key(&symbol.name)) {
            Entry::Occupied(first) => Err(*first.get()),
            Entry::Vacant(entry) => {
                entry.insert(position);
                if let Some(location) = &symbol.location {
                    self.by_address.entry(address::spelling(&location.text)).or_insert(position);
                }
                self.list.push(symbol);
                Ok(())
            }
        }
    }

    /// The symbols in the order of declaration.
    pub fn list(&self) -> &[Symbol] {
        &self.list
    }

    /// The symbol of a name or address, however it is spelt.
    pub fn find(&self, name: &str) -> Option<(usize, &Symbol)> {
        let position = match name.strip_prefix('%') {
            Some(_) => *self.by_address.get(&address::spelling(name))?,
            None => *self.by_key.get(&key(name))?,
        };
        Some((position, &self.list[position]))
    }

    /// The names as declared, for suggestions.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(|symbol| symbol.name.as_str())
    }
}
