//! Symbols: the names that a program organisation unit declares.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use super::address::{self, Area, Location};
use super::shape::{Shape, Value};
use crate::syntax::ast::key;
use petril_base::source::Span;

/// Section of a declaration, which determines who may write the variable and how long it lives.
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
    /// `VAR_TEMP`: initialised at every call.
    Temp,
    /// `CONSTANT`
    Constant,
    /// Result of a function.
    Result,
    /// `VAR_EXTERNAL`: stands for the global variable of this position.
    External(usize),
}

/// Declared name.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// Name as it was declared.
    pub name: String,
    /// Span of the name in its declaration.
    pub span: Span,
    /// Section of the declaration.
    pub section: Section,
    /// Shape of the variable; `None` if the declaration does not give one, which has been reported.
    pub shape: Option<Shape>,
    /// Value at power-on.
    pub initial: Value,
    /// Whether an initial value was written.
    pub is_given: bool,
    /// Address, if there is one.
    pub location: Option<Location>,
}

impl Symbol {
    /// Area of the address.
    pub fn area(&self) -> Option<Area> {
        self.location.as_ref().map(|location| location.area)
    }
}

/// Declared names, in the order of the text. Of a name declared twice the first declaration counts.
#[derive(Clone, Debug, Default)]
pub struct Symbols {
    list: Vec<Symbol>,
    by_key: BTreeMap<String, usize>,
    by_address: BTreeMap<String, usize>,
}

impl Symbols {
    /// Adds a symbol, unless there is one with this name: then returns its position as the error.
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

    /// Symbols in the order of declaration.
    pub fn list(&self) -> &[Symbol] {
        &self.list
    }

    /// Symbol with a name or address, in any spelling, and its position.
    pub fn find(&self, name: &str) -> Option<(usize, &Symbol)> {
        let position = match name.strip_prefix('%') {
            Some(_) => *self.by_address.get(&address::spelling(name))?,
            None => *self.by_key.get(&key(name))?,
        };
        Some((position, &self.list[position]))
    }

    /// Names as declared, for suggestions.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(|symbol| symbol.name.as_str())
    }
}
