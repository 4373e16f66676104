//! The names a program declares.

use std::collections::BTreeMap;

use super::program::{Role, VarId};
use crate::syntax::ast::{Constant, Name, Pou, VarBlock, VarKind, key};

/// The declared names of a program, in the order of the text. Of a name declared twice the first declaration counts.
pub struct Symbols<'a> {
    list: Vec<Symbol<'a>>,
    by_key: BTreeMap<String, VarId>,
}

/// A declared name.
pub struct Symbol<'a> {
    pub name: &'a Name,
    /// `None` where the declaration is broken, or of a kind or type that is not supported, which is reported elsewhere.
    pub role: Option<Role>,
    pub initial: Option<&'a Constant>,
}

impl<'a> Symbols<'a> {
    pub fn of(pou: &'a Pou) -> Self {
        let mut symbols = Self { list: Vec::new(), by_key: BTreeMap::new() };
        for block in &pou.blocks {
            for declaration in &block.declarations {
                let is_bool = declaration.type_text.as_ref().is_some_and(|written| key(&written.text) == "BOOL");
                let role = role(block).filter(|_| is_bool);
                for name in &declaration.names {
                    let id = VarId(symbols.list.len());
                    symbols.by_key.entry(name.key()).or_insert_with(|| {
                        symbols.list.push(Symbol { name, role, initial: declaration.initial.as_ref() });
                        id
                    });
                }
            }
        }
        symbols
    }

    /// The symbols in the order of declaration: position = [`VarId`].
    pub fn list(&self) -> &[Symbol<'a>] {
        &self.list
    }

    /// The symbol of a name, however it is spelt.
    pub fn find(&self, name: &str) -> Option<(VarId, &Symbol<'a>)> {
        let id = *self.by_key.get(&key(name))?;
        Some((id, &self.list[id.0]))
    }

    /// The names as declared, for suggestions.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(|symbol| symbol.name.text.as_str())
    }
}

fn role(block: &VarBlock) -> Option<Role> {
    match (block.kind, block.constant) {
        (VarKind::Local, false) => Some(Role::Memory),
        (VarKind::Local, true) => Some(Role::Constant),
        (VarKind::Input, false) => Some(Role::Input),
        (VarKind::Output, false) => Some(Role::Output),
        _ => None,
    }
}
