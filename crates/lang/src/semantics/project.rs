//! Declarations of a file and of the library: program organisation units, types, global variables.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use super::declare::{Declare, enumerator};
use super::shape::{Enumeration, PouId};
use super::symbols::{Section, Symbol, Symbols};
use super::{Context, address, control_flow, library, variables};
use crate::syntax::ast::{Pou, PouKind, Unit};
use petril_base::Type;
use petril_base::diagnostic::{Code, Diagnostic};

/// Declarations of a file and of the library.
pub struct Project<'a> {
    pub unit: &'a Unit,
    /// Units of the file, then those of the library; [`PouId`] is the position.
    pub pous: Vec<&'a Pou>,
    by_name: BTreeMap<String, PouId>,
    /// Names that each unit declares.
    pub symbols: Vec<Symbols>,
    /// Global variables, and addresses that are used without a declaration.
    pub globals: Symbols,
    enumerations: Vec<Rc<Enumeration>>,
    /// Position of the first unit of the library.
    own: usize,
}

impl<'a> Project<'a> {
    /// Reads the declarations of a file; returns its diagnostics, and those of each unit's declarations.
    pub fn of(unit: &'a Unit) -> (Self, Vec<Diagnostic>, Vec<Vec<Diagnostic>>) {
        let mut by_name = BTreeMap::new();
        let pous: Vec<&Pou> = unit.pous.iter().chain(&library::unit().pous).collect();
        let own = unit.pous.len();
        let mut found = Vec::new();
        for (i, pou) in pous.iter().enumerate() {
            match by_name.get(&pou.name.key()) {
                None => {
                    by_name.insert(pou.name.key(), PouId(i));
                }
                Some(PouId(first)) if i < own => {
                    let message = format!("`{}` is defined twice", pou.name.text);
                    found.push(
                        Diagnostic::new(Code::PouDeclaredTwice, pou.name.span, message)
                            .also(pous[*first].name.span, "first defined here")
                            .help("rename one of them"),
                    );
                }
                Some(_) => {}
            }
        }
        found.extend(names_of_types(unit, &pous[..own]));
        let is_block = |id: &PouId| pous[id.0].kind == PouKind::FunctionBlock;
        let blocks = by_name.iter().filter(|(_, id)| is_block(id)).map(|(name, id)| (name.clone(), *id)).collect();
        let mut read = Declarations::of(unit, &pous, &blocks, None);
        if read.needs_units {
            // Initial values of instances name variables of units, which may stand further down.
            read = Declarations::of(unit, &pous, &blocks, Some(read.symbols));
        }
        found.extend(read.found);
        let Declarations { globals, symbols, enumerations, of_units, .. } = read;
        (Self { unit, pous, by_name, symbols, globals, enumerations, own }, found, of_units)
    }

    /// Unit with a name.
    pub fn find(&self, name: &str) -> Option<PouId> {
        self.by_name.get(&crate::syntax::ast::key(name)).copied()
    }

    pub fn pou(&self, id: PouId) -> &'a Pou {
        self.pous[id.0]
    }

    pub fn symbols(&self, id: PouId) -> &Symbols {
        &self.symbols[id.0]
    }

    /// Input of the static rules for a unit.
    pub fn context(&self, id: PouId) -> Context<'_> {
        let pou = self.pou(id);
        let labels = control_flow::labels(&pou.body);
        Context { project: self, id, pou, symbols: self.symbols(id), labels, flow: OnceCell::new() }
    }

    /// Whether a unit belongs to the library.
    pub fn is_library(&self, id: PouId) -> bool {
        id.0 >= self.own
    }

    /// Enumeration with a name.
    pub fn enumeration(&self, name: &str) -> Option<Rc<Enumeration>> {
        self.enumerations.iter().find(|enumeration| enumeration.name.eq_ignore_ascii_case(name)).cloned()
    }

    /// Enumerations that have a value with this name, with its number.
    pub fn enumerators(&self, name: &str) -> Vec<(Rc<Enumeration>, usize)> {
        enumerator(&self.enumerations, name)
    }

    /// Names of all enumerations.
    pub fn enumeration_names(&self) -> impl Iterator<Item = &str> {
        self.enumerations.iter().map(|enumeration| enumeration.name.as_str())
    }

    /// Names of the values of all enumerations.
    pub fn enumerator_names(&self) -> impl Iterator<Item = &str> {
        self.enumerations.iter().flat_map(|enumeration| enumeration.values.iter()).map(String::as_str)
    }

    /// Variable that a name stands for in a unit: its own, or a global one (as its position among these).
    pub fn variable(&self, id: PouId, name: &str) -> Option<(Section, usize, &Symbol)> {
        if let Some((position, symbol)) = self.symbols(id).find(name) {
            return Some((symbol.section, position, symbol));
        }
        let (position, symbol) = self.globals.find(name)?;
        Some((Section::External(position), position, symbol))
    }
}

/// Result of reading the declarations of a file.
struct Declarations {
    globals: Symbols,
    symbols: Vec<Symbols>,
    enumerations: Vec<Rc<Enumeration>>,
    /// Whether an initial value needs the variables of the units.
    needs_units: bool,
    /// Diagnostics of types and global variables.
    found: Vec<Diagnostic>,
    /// Diagnostics of each unit's variables.
    of_units: Vec<Vec<Diagnostic>>,
}

impl Declarations {
    /// Reads the declarations; `known` are the variables of the units, if they have been read before.
    fn of(unit: &Unit, pous: &[&Pou], blocks: &BTreeMap<String, PouId>, known: Option<Vec<Symbols>>) -> Self {
        let mut declare = Declare::new(&unit.types, blocks, known);
        let mut globals = variables::global(&unit.globals, &mut declare);
        address::undeclared(unit, &mut globals);
        let found = std::mem::take(&mut declare.diagnostics);
        let read = |pou: &&Pou| {
            let symbols = variables::of_unit(pou, &globals, &mut declare);
            (symbols, std::mem::take(&mut declare.diagnostics))
        };
        let (symbols, of_units) = pous.iter().map(read).unzip();
        let Declare { enumerations, needs_units, .. } = declare;
        Self { globals, symbols, enumerations, needs_units, found, of_units }
    }
}

/// Reports types that have the name of a unit, or of an elementary type.
fn names_of_types<'a>(unit: &'a Unit, pous: &'a [&Pou]) -> impl Iterator<Item = Diagnostic> + 'a {
    let by_name: BTreeMap<String, &Pou> = pous.iter().rev().map(|pou| (pou.name.key(), *pou)).collect();
    unit.types.iter().filter_map(move |declaration| {
        let name = &declaration.name;
        let message = |what: String| {
            Diagnostic::new(Code::PouDeclaredTwice, name.span, format!("`{}` is the name of {what}", name.text))
        };
        if Type::named(&name.text).is_some() {
            return Some(message("an elementary type".to_owned()).help("give the type another name"));
        }
        let pou = by_name.get(&name.key())?;
        Some(message(format!("a `{}`, too", pou.kind)).also(pou.name.span, "defined here").help("rename one of them"))
    })
}
