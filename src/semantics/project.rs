//! Everything a file declares, and the library beside it: program organisation units, types, global variables.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::declare::{Declare, enumerator};
use super::initial::Constants;
use super::shape::{Enumeration, PouId, Scalar, Shape, Value};
use super::symbols::{Area, Section, Symbol, Symbols, address};
use super::types::{Kind, Type};
use super::{Context, control_flow, library, uses};
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::{Declaration, Name, Operation, Path, Pou, PouKind, Unit, VarBlock, VarKind, with_nested};

/// A file and the library.
pub struct Project<'a> {
    pub unit: &'a Unit,
    /// The units of the file, then those of the library; [`PouId`] is the position.
    pub pous: Vec<&'a Pou>,
    by_name: BTreeMap<String, PouId>,
    /// The names that each unit declares.
    pub symbols: Vec<Symbols>,
    /// Global variables, and addresses that are used without a declaration.
    pub globals: Symbols,
    enumerations: Vec<Rc<Enumeration>>,
    /// The first unit of the library.
    own: usize,
}

impl<'a> Project<'a> {
    /// Reads the declarations of a file. The second list has what is wrong with each unit's.
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
        // Initial values of instances name variables of units that may stand further down, so all is read twice.
        let known = Declarations::of(unit, &pous, &blocks, None).symbols;
        let read = Declarations::of(unit, &pous, &blocks, Some(known));
        found.extend(read.found);
        let Declarations { globals, symbols, enumerations, of_units, .. } = read;
        (Self { unit, pous, by_name, symbols, globals, enumerations, own }, found, of_units)
    }

    /// The unit of a name.
    pub fn find(&self, name: &str) -> Option<PouId> {
        self.by_name.get(&crate::syntax::ast::key(name)).copied()
    }

    pub fn pou(&self, id: PouId) -> &'a Pou {
        self.pous[id.0]
    }

    pub fn symbols(&self, id: PouId) -> &Symbols {
        &self.symbols[id.0]
    }

    /// What the rules look at.
    pub fn context(&self, id: PouId) -> Context<'_> {
        let pou = self.pou(id);
        Context { project: self, id, pou, symbols: self.symbols(id), labels: control_flow::labels(&pou.body) }
    }

    /// Whether a unit belongs to the library.
    pub fn is_library(&self, id: PouId) -> bool {
        id.0 >= self.own
    }

    /// The enumeration of a name.
    pub fn enumeration(&self, name: &str) -> Option<Rc<Enumeration>> {
        self.enumerations.iter().find(|enumeration| enumeration.name.eq_ignore_ascii_case(name)).cloned()
    }

    /// The enumerations that have a value of this name.
    pub fn enumerators(&self, name: &str) -> Vec<(Rc<Enumeration>, usize)> {
        enumerator(&self.enumerations, name)
    }

    /// The names of all enumerations.
    pub fn enumeration_names(&self) -> impl Iterator<Item = &str> {
        self.enumerations.iter().map(|enumeration| enumeration.name.as_str())
    }

    /// The names of the values of all enumerations.
    pub fn enumerator_names(&self) -> impl Iterator<Item = &str> {
        self.enumerations.iter().flat_map(|enumeration| enumeration.values.iter()).map(String::as_str)
    }

    /// The variable a name stands for in a unit: its own, or a global one (as its position among these).
    pub fn variable(&self, id: PouId, name: &str) -> Option<(Section, usize, &Symbol)> {
        if let Some((position, symbol)) = self.symbols(id).find(name) {
            return Some((symbol.section, position, symbol));
        }
        let (position, symbol) = self.globals.find(name)?;
        Some((Section::External(position), position, symbol))
    }

    /// The units that a unit calls, each with the name that says so.
    pub fn calls(&self, id: PouId) -> Vec<(PouId, &Name)> {
        let pou = self.pou(id);
        let mut calls = Vec::new();
        for (instruction, _) in with_nested(&pou.body) {
            if let Some(Operation::Function { name, .. }) = &instruction.operation {
                calls.extend(self.find(&name.text).map(|callee| (callee, name)));
            }
        }
        for declaration in pou.blocks.iter().flat_map(|block| &block.declarations) {
            let shape = declaration.names.first().and_then(|name| self.symbols(id).find(&name.text)?.1.shape.as_ref());
            let mut inside = BTreeSet::new();
            shape.into_iter().for_each(|shape| instances(shape, &mut inside));
            calls.extend(inside.into_iter().zip(declaration.names.iter().cycle()));
        }
        calls
    }

    /// The units that a unit needs, itself last; what calls itself is reported.
    pub fn reachable(&self, entry: PouId, found: &mut Vec<Diagnostic>) -> Vec<PouId> {
        let mut done = Vec::new();
        let mut open = Vec::new();
        // Global variables may be instances too.
        let mut global = BTreeSet::new();
        self.globals.list().iter().filter_map(|symbol| symbol.shape.as_ref()).for_each(|s| instances(s, &mut global));
        global.into_iter().for_each(|id| self.visit(id, &mut open, &mut done, found));
        self.visit(entry, &mut open, &mut done, found);
        done
    }

    fn visit(&self, id: PouId, open: &mut Vec<PouId>, done: &mut Vec<PouId>, found: &mut Vec<Diagnostic>) {
        if done.contains(&id) {
            return;
        }
        open.push(id);
        for (callee, name) in self.calls(id) {
            match open.iter().position(|&outer| outer == callee) {
                Some(first) => {
                    let way: Vec<&str> = open[first..].iter().map(|&id| self.pou(id).name.text.as_str()).collect();
                    let message = format!("`{}` calls itself", self.pou(callee).name.text);
                    let help = format!("{} → {}: recursion is forbidden (IEC 61131-3, 2.5)", way.join(" → "), way[0]);
                    let known = found.iter().any(|d| d.code == Code::Recursion && d.span() == name.span);
                    if !known {
                        found.push(Diagnostic::new(Code::Recursion, name.span, message).help(help));
                    }
                }
                // Units are called at most this deep; the limit keeps everything that follows calls within its stack.
                None if open.len() < 100 => self.visit(callee, open, done, found),
                None => {
                    let message = "calls are nested more than 100 deep here";
                    found.push(Diagnostic::new(Code::ProgramTooLarge, name.span, message));
                }
            }
        }
        open.pop();
        if !done.contains(&id) {
            done.push(id);
        }
    }
}

/// What the declarations of a file say.
struct Declarations {
    globals: Symbols,
    symbols: Vec<Symbols>,
    enumerations: Vec<Rc<Enumeration>>,
    /// What is wrong with types and global variables.
    found: Vec<Diagnostic>,
    /// What is wrong with each unit's variables.
    of_units: Vec<Vec<Diagnostic>>,
}

impl Declarations {
    /// Reads them; `known` are the variables of the units, if they have been read before.
    fn of(unit: &Unit, pous: &[&Pou], blocks: &BTreeMap<String, PouId>, known: Option<Vec<Symbols>>) -> Self {
        let mut declare = Declare::new(&unit.types, blocks, known);
        let mut globals = Symbols::default();
        let none = Symbols::default();
        unit.globals.iter().for_each(|block| self::block(block, &mut globals, &none, &mut declare, false));
        addresses(unit, &mut globals);
        let found = std::mem::take(&mut declare.diagnostics);
        let read = |pou: &&Pou| {
            let symbols = symbols(pou, &globals, &mut declare);
            (symbols, std::mem::take(&mut declare.diagnostics))
        };
        let (symbols, of_units) = pous.iter().map(read).unzip();
        Self { globals, symbols, enumerations: declare.enumerations, found, of_units }
    }
}

/// The function blocks that a shape holds instances of.
fn instances(shape: &Shape, found: &mut BTreeSet<PouId>) {
    match shape {
        Shape::Scalar(_) => {}
        Shape::Array { of, .. } => instances(of, found),
        Shape::Structure(structure) => structure.members.iter().for_each(|member| instances(&member.shape, found)),
        Shape::Instance(id) => {
            found.insert(*id);
        }
    }
}

/// Makes a global variable of every address that is used without a declaration.
fn addresses(unit: &Unit, globals: &mut Symbols) {
    let mut paths: Vec<&Path> = Vec::new();
    for pou in &unit.pous {
        let declared = pou.blocks.iter().flat_map(|block| &block.declarations).filter_map(|d| d.location.as_ref());
        let declared: BTreeSet<String> = declared.map(|location| address(&location.text)).collect();
        let used = uses::paths(&pou.body, None)
            .into_iter()
            .map(|(path, _)| path)
            .filter(|path| path.root.text.starts_with('%'));
        paths.extend(used.filter(|path| !declared.contains(&address(&path.root.text))));
    }
    for path in paths {
        let Some((area, ty)) = read_address(&path.root.text) else { continue };
        if globals.find(&path.root.text).is_some() {
            continue;
        }
        let symbol = Symbol {
            name: address(&path.root.text),
            span: path.root.span,
            section: Section::Local,
            shape: Some(Shape::Scalar(Scalar::new(ty.unwrap_or(Type::BOOL)))),
            initial: Value::Default,
            is_given: false,
            area: Some(area),
        };
        if let Ok(position) = globals.add(symbol) {
            let _ = globals.locate(address(&path.root.text), position);
        }
    }
}

/// The area and size of an address like `%IX0.0`; no size is written in `%I0.0`.
pub fn read_address(text: &str) -> Option<(Area, Option<Type>)> {
    let text = text.to_ascii_uppercase();
    let mut letters = text.strip_prefix('%')?.chars();
    let area = match letters.next()? {
        'I' => Area::Input,
        'Q' => Area::Output,
        'M' => Area::Memory,
        _ => return None,
    };
    let mut rest = letters.as_str();
    let size = rest.chars().next().filter(char::is_ascii_alphabetic);
    let width = match size {
        None => None,
        Some('X') => Some(1),
        Some('B') => Some(8),
        Some('W') => Some(16),
        Some('D') => Some(32),
        Some('L') => Some(64),
        Some(_) => return None,
    };
    if size.is_some() {
        rest = &rest[1..];
    }
    let numbers = rest.split('.').all(|part| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit()));
    numbers.then(|| (area, width.map(|width| Type::new(Kind::Bits, width))))
}

/// The names a unit declares.
fn symbols(pou: &Pou, globals: &Symbols, declare: &mut Declare<'_>) -> Symbols {
    let mut symbols = Symbols::default();
    if pou.kind == PouKind::Function {
        result(pou, &mut symbols, declare);
    }
    declare.in_function = pou.kind == PouKind::Function;
    for block in &pou.blocks {
        let may_locate = pou.kind == PouKind::Program;
        self::block(block, &mut symbols, globals, declare, may_locate);
    }
    symbols
}

/// A function's result is a variable of its name.
fn result(pou: &Pou, symbols: &mut Symbols, declare: &mut Declare<'_>) {
    let report = |message: String, help: &str| {
        let span = pou.result.as_ref().map_or(pou.name.span, |result| result.span);
        Diagnostic::new(Code::FunctionResult, span, message).help(help)
    };
    let shape = match &pou.result {
        None => {
            let message = format!("the function `{}` has no result type", pou.name.text);
            declare
                .diagnostics
                .push(report(message, &format!("write it behind the name, like `FUNCTION {} : INT`", pou.name.text)));
            None
        }
        Some(result) => {
            let spec = crate::syntax::ast::TypeSpec::Named(result.clone());
            match declare.shape(&spec, Constants::none()).map(|(shape, _)| shape) {
                Some(shape) if shape.scalar().is_none() => {
                    let message = format!("a function cannot return {shape}");
                    declare
                        .diagnostics
                        .push(report(message, "return one elementary value, and the others by `VAR_OUTPUT`"));
                    None
                }
                shape => shape,
            }
        }
    };
    let _ = symbols.add(Symbol {
        name: pou.name.text.clone(),
        span: pou.name.span,
        section: Section::Result,
        shape,
        initial: Value::Default,
        is_given: false,
        area: None,
    });
}

fn block(block: &VarBlock, symbols: &mut Symbols, globals: &Symbols, declare: &mut Declare<'_>, may_locate: bool) {
    if let Some(diagnostic) = unsupported(block) {
        declare.diagnostics.push(diagnostic);
    }
    if let Some(word) = block.retain.as_ref().filter(|word| !word.is("NON_RETAIN")) {
        let message = format!("`{}` variables are modelled as after a cold start", word.key());
        let help = "every variable begins with its initial value; values kept over a loss of power are not explored";
        declare.diagnostics.push(Diagnostic::new(Code::RetainColdStart, word.span, message).help(help));
    }
    for declaration in &block.declarations {
        declaration_of(declaration, block, symbols, globals, declare, may_locate || block.kind == VarKind::Global);
    }
}

fn unsupported(block: &VarBlock) -> Option<Diagnostic> {
    let refuse = |what: String, help: &str| {
        Some(Diagnostic::new(Code::DeclarationNotSupported, block.span, format!("{what} is not supported")).help(help))
    };
    match block.kind {
        VarKind::Access => {
            refuse("`VAR_ACCESS` or `VAR_CONFIG`".to_owned(), "it concerns communication, not the program")
        }
        VarKind::Input | VarKind::Output | VarKind::InOut | VarKind::Temp if block.constant => {
            refuse(format!("a constant `{}`", block.kind), "declare it in `VAR CONSTANT`")
        }
        _ => None,
    }
}

fn declaration_of(
    declaration: &Declaration,
    block: &VarBlock,
    symbols: &mut Symbols,
    globals: &Symbols,
    declare: &mut Declare<'_>,
    may_locate: bool,
) {
    let constants = Constants::of(symbols, globals);
    let shaped = declaration.spec.as_ref().and_then(|spec| declare.shape(spec, constants));
    let value = match (&declaration.initial, &shaped) {
        (Some(initial), Some((shape, _))) => declare.value(initial, shape, constants),
        (_, Some((_, default))) => Some(default.clone()),
        (_, None) => None,
    };
    if let Some(edge) = &declaration.edge {
        let message = format!("`{}` is not supported", edge.key());
        let help = "declare an instance of R_TRIG or F_TRIG, and call it with the input";
        declare.diagnostics.push(Diagnostic::new(Code::DeclarationNotSupported, edge.span, message).help(help));
    }
    if let Some((shape, _)) = &shaped
        && let Some(diagnostic) = instance(declaration, block, shape, declare.in_function)
    {
        declare.diagnostics.push(diagnostic);
    }
    for name in &declaration.names {
        let section = match block.kind {
            VarKind::Input => Section::Input,
            VarKind::Output => Section::Output,
            VarKind::InOut => Section::InOut,
            VarKind::Temp => Section::Temp,
            VarKind::External => match globals.find(&name.text) {
                Some((position, _)) => Section::External(position),
                None => {
                    let message = format!("there is no global variable `{}`", name.text);
                    declare.diagnostics.push(
                        Diagnostic::new(Code::ExternalWithoutGlobal, name.span, message)
                            .suggest(&name.text, globals.names())
                            .help("declare it in `VAR_GLOBAL`, in this file outside of all programs or in its configuration"),
                    );
                    Section::External(usize::MAX)
                }
            },
            _ if block.constant => Section::Constant,
            _ => Section::Local,
        };
        let mut symbol = Symbol {
            name: name.text.clone(),
            span: name.span,
            section,
            shape: shaped.as_ref().map(|(shape, _)| shape.clone()),
            initial: value.clone().unwrap_or(Value::Default),
            is_given: declaration.initial.is_some(),
            area: None,
        };
        if let Section::External(position) = section {
            external(name, &mut symbol, globals.list().get(position), declare);
        }
        let area = declaration.location.as_ref().and_then(|location| located(location, &symbol, may_locate, declare));
        symbol.area = area;
        let span = symbol.span;
        match symbols.add(symbol) {
            Ok(position) => {
                if let Some(location) = &declaration.location
                    && let Err(first) = symbols.locate(address(&location.text), position)
                {
                    let first = &symbols.list()[first];
                    let message = format!("`{}` has the address of `{}`", name.text, first.name);
                    declare.diagnostics.push(
                        Diagnostic::new(Code::AddressShared, location.span, message)
                            .also(first.span, "declared here")
                            .help("use one variable; two names for one place are not modelled"),
                    );
                }
            }
            // Of a declaration that cannot be read, nobody knows which words are names.
            Err(first) if declaration.spec.is_some() => {
                let first = &symbols.list()[first];
                let message = format!("`{}` is declared twice", name.text);
                let again = Diagnostic::new(Code::NameDeclaredTwice, span, message).here("declared again");
                let first = if first.section == Section::Result {
                    "the function's result is declared here"
                } else {
                    "first declared here"
                };
                let at = symbols.find(&name.text).map_or(span, |(_, symbol)| symbol.span);
                declare.diagnostics.push(again.also(at, first).help("remove or rename one of them"));
            }
            Err(_) => {}
        }
    }
}

/// An instance keeps its state from call to call, so it cannot stand where variables begin anew or are copied.
fn instance(declaration: &Declaration, block: &VarBlock, shape: &Shape, in_function: bool) -> Option<Diagnostic> {
    let mut inside = BTreeSet::new();
    instances(shape, &mut inside);
    let why = match block.kind {
        _ if inside.is_empty() => return None,
        VarKind::Temp => "`VAR_TEMP` variables begin anew with every call",
        VarKind::Input | VarKind::Output => "inputs and outputs are copied with every call",
        VarKind::Local if block.constant => "constants never change",
        VarKind::Local if in_function => "the variables of a function begin anew with every call",
        _ => return None,
    };
    let span = declaration.spec.as_ref()?.span();
    let help = if in_function {
        "make the function a function block, or hand the instance over in `VAR_IN_OUT`"
    } else {
        "declare it in `VAR`, or hand it over in `VAR_IN_OUT`"
    };
    let message = "an instance of a function block keeps its state, which it cannot do here";
    Some(Diagnostic::new(Code::InstanceUnfit, span, message).here(why).help(help))
}

/// Types that have the name of a unit, or of a type that exists already.
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

/// An external variable is what the global one is.
fn external(name: &Name, symbol: &mut Symbol, global: Option<&Symbol>, declare: &mut Declare<'_>) {
    let Some(global) = global else { return };
    let (Some(own), Some(other)) = (&symbol.shape, &global.shape) else { return };
    if !own.same(other) {
        let message = format!("`{}` is `{own}` here, but the global variable is `{other}`", name.text);
        declare
            .diagnostics
            .push(Diagnostic::new(Code::TypesDiffer, name.span, message).also(global.span, "declared here"));
        symbol.shape = None;
    }
}

/// Checks an address against its variable.
fn located(location: &Name, symbol: &Symbol, may_locate: bool, declare: &mut Declare<'_>) -> Option<Area> {
    let mut unfit = |message: String, help: &str| {
        declare.diagnostics.push(Diagnostic::new(Code::AddressUnfit, location.span, message).help(help));
        None
    };
    let Some((area, size)) = read_address(&location.text) else {
        let message = format!("`{}` is no address that can be read", location.text);
        return unfit(message, "an address is like `%IX0.0`, `%QW3` or `%MD12`");
    };
    if !may_locate {
        let message = format!("`{}` stands where no address may", location.text);
        return unfit(message, "only variables of programs and global variables have addresses");
    }
    let fits = match (symbol.section, area) {
        (Section::Input, area) => area == Area::Input,
        (Section::Output, area) => area == Area::Output,
        (Section::Local, _) => true,
        _ => false,
    };
    if !fits {
        let message = format!("`{}` is no address for `{}`", location.text, symbol.name);
        return unfit(message, "inputs are at `%I…`, outputs at `%Q…`, memory at `%M…`");
    }
    let width = symbol.shape.as_ref().and_then(Shape::scalar).map(|scalar| scalar.ty.width);
    match (size, width) {
        (Some(size), Some(width)) if size.width != width => {
            let bits = |n| if n == 1 { "1 bit".to_owned() } else { format!("{n} bits") };
            let (own, needed) = (bits(size.width), bits(width));
            let message = format!("`{}` has {own}, but `{}` needs {needed}", location.text, symbol.name);
            unfit(message, "X stands for one bit, B for 8, W for 16, D for 32, L for 64")
        }
        _ => Some(area),
    }
}
