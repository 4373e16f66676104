//! Declarations to shapes and values at power-on.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::constant::{number, wider};
use super::shape::{Enumeration, Member, PouId, Scalar, Shape, Structure, Value, elements};
use super::symbols::{Section, Symbol, Symbols};
use super::types::{Kind, Type};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Initial, InitialKind, Literal, Name, Range, TypeDeclaration, TypeSpec};

/// A variable may have as many values as this.
const MAX_ELEMENTS: usize = 1 << 16;

/// A type may be made of types that are made of types …, as deep as this.
const MAX_DEPTH: usize = 100;

/// The types of a file, and what else a declaration may name.
pub struct Declare<'a> {
    declared: BTreeMap<String, &'a TypeDeclaration>,
    resolved: BTreeMap<String, Option<(Shape, Value)>>,
    open: Vec<String>,
    blocks: &'a BTreeMap<String, PouId>,
    /// Every enumeration, for the names of its values.
    pub enumerations: Vec<Rc<Enumeration>>,
    pub diagnostics: Vec<Diagnostic>,
    /// Whether the unit that is read is a function.
    pub in_function: bool,
    /// The variables of the units, once they are known.
    known: Option<Vec<Symbols>>,
}

/// The variables that a declaration may name: those before it, and global ones.
pub struct Scope<'a> {
    pub own: &'a Symbols,
    pub globals: &'a Symbols,
}

impl Scope<'_> {
    fn find(&self, name: &str) -> Option<&Symbol> {
        self.own.find(name).or_else(|| self.globals.find(name)).map(|(_, symbol)| symbol)
    }
}

impl<'a> Declare<'a> {
    /// The types of a file; `blocks` are the function blocks that exist, `known` the variables of all units, once they have
    /// been read.
    pub fn new(types: &'a [TypeDeclaration], blocks: &'a BTreeMap<String, PouId>, known: Option<Vec<Symbols>>) -> Self {
        let mut declare = Self {
            declared: BTreeMap::new(),
            resolved: BTreeMap::new(),
            open: Vec::new(),
            blocks,
            enumerations: Vec::new(),
            diagnostics: Vec::new(),
            in_function: false,
            known,
        };
        for declaration in types {
            let name = &declaration.name;
            let first = *declare.declared.entry(name.key()).or_insert(declaration);
            if first.name.span != name.span {
                declare.report(
                    Code::PouDeclaredTwice,
                    name.span,
                    format!("the type `{}` is declared twice", name.text),
                    |d| d.also(first.name.span, "first declared here").help("rename one of them"),
                );
            }
        }
        for declaration in types {
            declare.named(&declaration.name);
        }
        declare
    }

    fn report(&mut self, code: Code, span: Span, message: String, more: impl FnOnce(Diagnostic) -> Diagnostic) {
        self.diagnostics.push(more(Diagnostic::new(code, span, message)));
    }

    /// What a type specification stands for, and the value that its variables have at power-on. `None` has been reported.
    pub fn shape(&mut self, spec: &TypeSpec, constants: &Scope<'_>) -> Option<(Shape, Value)> {
        match spec {
            TypeSpec::Named(name) => self.named(name),
            TypeSpec::Subrange { base, range } => {
                let (shape, _) = self.named(base)?;
                let ty = shape.scalar().filter(|scalar| scalar.enumeration.is_none()).map(|scalar| scalar.ty);
                let Some(ty) = ty.filter(|ty| matches!(ty.kind, Kind::Signed | Kind::Unsigned)) else {
                    let message = format!("`{}` has no subranges", base.text);
                    self.report(Code::RangeUnfit, base.span, message, |d| d.help("only integer types have"));
                    return None;
                };
                let (lower, upper) = self.range(range, constants)?;
                if !ty.holds(lower) || !ty.holds(upper) {
                    let message = format!("the range {lower}..{upper} goes beyond `{ty}`");
                    let help = format!("`{ty}` goes from {} to {}", ty.least(), ty.greatest());
                    self.report(Code::RangeUnfit, range.lower.span.to(range.upper.span), message, |d| d.help(help));
                    return None;
                }
                let range = Some((lower, upper));
                let scalar = Scalar { range, default: ty.pattern(lower), ..Scalar::new(ty) };
                Some((Shape::Scalar(scalar), Value::Default))
            }
            TypeSpec::Enumeration(values) => self.enumeration(None, values),
            TypeSpec::Array { ranges, of, span } => {
                let mut numbers = Vec::new();
                for range in ranges {
                    let (lower, upper) = self.range(range, constants)?;
                    let whole = i64::try_from(lower).ok().zip(i64::try_from(upper).ok());
                    let length = upper.checked_sub(lower).filter(|&length| length < MAX_ELEMENTS as i128);
                    numbers.extend(length.and(whole));
                }
                let (of, initial) = self.shape(of, constants)?;
                let count = numbers.iter().try_fold(leaves(&of), |n, (lower, upper)| {
                    n.checked_mul((upper - lower + 1) as usize).filter(|&n| n <= MAX_ELEMENTS)
                });
                if numbers.len() < ranges.len() || count.is_none() {
                    let message = format!("this array has more than {MAX_ELEMENTS} values");
                    self.report(Code::VariableTooLarge, *span, message, |d| {
                        d.help("every value becomes places of the net; make the array as large as the program needs it")
                    });
                    return None;
                }
                let initial = repeated(&initial, elements(&numbers));
                Some((Shape::Array { ranges: numbers, of: Box::new(of) }, initial))
            }
            TypeSpec::Structure { members, span } => self.structure(("a structure", *span), members, constants),
        }
    }

    fn structure(
        &mut self,
        (name, span): (&str, Span),
        declarations: &[crate::syntax::ast::Declaration],
        constants: &Scope<'_>,
    ) -> Option<(Shape, Value)> {
        let mut members: Vec<Member> = Vec::new();
        for declaration in declarations {
            let (shape, default) = self.shape(declaration.spec.as_ref()?, constants)?;
            let initial = match &declaration.initial {
                Some(initial) => self.value(initial, &shape, constants)?,
                None => default,
            };
            for name in &declaration.names {
                if members.iter().any(|member| member.name.eq_ignore_ascii_case(&name.text)) {
                    let message = format!("the member `{}` is declared twice", name.text);
                    self.report(Code::NameDeclaredTwice, name.span, message, |d| d);
                    continue;
                }
                members.push(Member { name: name.text.clone(), shape: shape.clone(), initial: initial.clone() });
            }
        }
        let shape = Shape::Structure(Rc::new(Structure { name: name.to_owned(), members }));
        if leaves(&shape) > MAX_ELEMENTS {
            let message = format!("this structure has more than {MAX_ELEMENTS} values");
            self.report(Code::VariableTooLarge, span, message, |d| {
                d.help("make its arrays as large as the program needs them")
            });
            return None;
        }
        Some((shape, Value::Default))
    }

    fn enumeration(&mut self, name: Option<&str>, values: &[Name]) -> Option<(Shape, Value)> {
        for (i, value) in values.iter().enumerate() {
            if let Some(first) = values[..i].iter().find(|first| first.key() == value.key()) {
                let message = format!("the value `{}` is named twice", value.text);
                let first = first.span;
                self.report(Code::NameDeclaredTwice, value.span, message, |d| d.also(first, "first named here"));
            }
        }
        let values: Vec<String> = values.iter().map(|value| value.text.clone()).collect();
        let name = name.map_or_else(|| format!("({})", values.join(", ")), str::to_owned);
        let width = if values.len() <= 1 << 8 { 8 } else { 16 };
        let enumeration = Rc::new(Enumeration { name, values });
        self.enumerations.push(enumeration.clone());
        let ty = Type::new(Kind::Unsigned, width);
        let range = Some((0, enumeration.values.len() as i128 - 1));
        let scalar = Scalar { ty, range, enumeration: Some(enumeration), default: 0 };
        Some((Shape::Scalar(scalar), Value::Default))
    }

    fn named(&mut self, name: &Name) -> Option<(Shape, Value)> {
        let key = name.key();
        if let Some(ty) = Type::named(&key) {
            return Some((Shape::Scalar(Scalar::new(ty)), Value::Default));
        }
        if let Some(known) = self.resolved.get(&key) {
            return known.clone();
        }
        // A type of the file comes before a function block of the library.
        let Some(&declaration) = self.declared.get(&key) else {
            let block = self.blocks.get(&key).map(|&block| (Shape::Instance(block), Value::Default));
            if block.is_none() {
                self.unknown(name);
            }
            return block;
        };
        if self.open.len() >= MAX_DEPTH {
            let message = format!("types are nested more than {MAX_DEPTH} deep here");
            self.report(Code::VariableTooLarge, name.span, message, |d| d);
            return None;
        }
        if self.open.contains(&key) {
            let message = format!("the type `{}` contains itself", name.text);
            self.report(Code::TypeRecursive, name.span, message, |d| {
                d.also(declaration.name.span, "declared here")
                    .help("refer to another one by a number, like its index in an array")
            });
            return None;
        }
        self.open.push(key.clone());
        let resolved = self.declaration(declaration);
        self.open.pop();
        self.resolved.insert(key, resolved.clone());
        resolved
    }

    fn declaration(&mut self, declaration: &TypeDeclaration) -> Option<(Shape, Value)> {
        let nothing = Symbols::default();
        let none = Scope { own: &nothing, globals: &nothing };
        let (mut shape, default) = match declaration.spec.as_ref()? {
            TypeSpec::Enumeration(values) => self.enumeration(Some(&declaration.name.text), values)?,
            TypeSpec::Structure { members, .. } => {
                self.structure((&declaration.name.text, declaration.name.span), members, &none)?
            }
            other => self.shape(other, &none)?,
        };
        let value = match &declaration.initial {
            Some(initial) => self.value(initial, &shape, &none)?,
            None => default,
        };
        if let (Shape::Scalar(scalar), Value::Scalar(pattern)) = (&mut shape, &value) {
            scalar.default = *pattern;
        }
        Some((shape, value))
    }

    fn unknown(&mut self, name: &Name) {
        let word = name.key();
        let word = word.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).next().unwrap_or_default();
        let what = match word {
            "REAL" | "LREAL" => "floating-point numbers are",
            "STRING" | "WSTRING" | "CHAR" | "WCHAR" => "character strings are",
            "DATE" | "TOD" | "TIME_OF_DAY" | "DT" | "DATE_AND_TIME" | "LDATE" | "LTOD" | "LDT" => "dates are",
            "LTIME" => "times of 64 bits are",
            "POINTER" | "REFERENCE" | "REF_TO" => "pointers are",
            "ANY" | "ANY_INT" | "ANY_NUM" | "ANY_BIT" | "ANY_REAL" => "generic types are",
            "RTC" | "SEMA" => "this standard function block is",
            _ => {
                let names: Vec<String> = self.declared.values().map(|declared| declared.name.text.clone()).collect();
                let known = Type::ALL.iter().map(|(name, _)| *name).chain(names.iter().map(String::as_str));
                let known: Vec<&str> = known.chain(self.blocks.keys().map(String::as_str)).collect();
                let message = format!("there is no type `{}`", name.text);
                self.diagnostics.push(
                    Diagnostic::new(Code::TypeNotDeclared, name.span, message)
                        .suggest(&name.text, known)
                        .help("declare it in `TYPE … END_TYPE`, or put its `FUNCTION_BLOCK` into this file"),
                );
                return;
            }
        };
        let message = format!("the type `{}` is not supported", name.text);
        self.report(Code::TypeNotSupported, name.span, message, |d| {
            d.here(format!("{what} not modelled"))
                .help("variables of types BOOL, BYTE to LWORD, SINT to ULINT and TIME are, and what is made of them")
        });
    }

    /// The numbers of a range, which is not empty.
    fn range(&mut self, range: &Range, constants: &Scope<'_>) -> Option<(i128, i128)> {
        let mut end = |bound: &Name| {
            let number = match Literal::read(&bound.text) {
                Some(Literal::Integer(number) | Literal::Typed(_, number)) => Some(number),
                _ => constants.find(&bound.text).and_then(constant),
            };
            if number.is_none() {
                let message = format!("`{}` is no number that is known here", bound.text);
                self.diagnostics.push(
                    Diagnostic::new(Code::RangeUnfit, bound.span, message)
                        .help("write a number, or the name of a constant declared before"),
                );
            }
            number
        };
        let (lower, upper) = (end(&range.lower), end(&range.upper));
        let (lower, upper) = (lower?, upper?);
        if lower > upper {
            let message = format!("the range {lower}..{upper} is empty");
            self.report(Code::RangeUnfit, range.lower.span.to(range.upper.span), message, |d| {
                d.help("write the least value first")
            });
            return None;
        }
        Some((lower, upper))
    }

    /// A value written for a shape. `None` has been reported.
    pub fn value(&mut self, initial: &Initial, shape: &Shape, constants: &Scope<'_>) -> Option<Value> {
        let unfit = |what: &str| {
            let message = format!("{what} is no value of type `{shape}`");
            Diagnostic::new(Code::InitialValueUnfit, initial.span, message)
        };
        match (&initial.kind, shape) {
            (InitialKind::Constant(constant), Shape::Scalar(scalar)) => match number(constant, scalar) {
                Ok(number) => Some(Value::Scalar(scalar.ty.pattern(number))),
                Err(why) => {
                    let message = format!("`{}` {why}", constant.text);
                    let diagnostic = Diagnostic::new(Code::InitialValueUnfit, initial.span, message);
                    self.diagnostics.push(match wider(constant, scalar) {
                        _ if scalar.ty.is_bool() => diagnostic.help("write `TRUE` or `FALSE`"),
                        Some(ty) => diagnostic.help(format!("the type `{ty}` has it")),
                        None if scalar.ty == Type::TIME && matches!(constant.literal, Some(Literal::Integer(_))) => {
                            diagnostic.help(format!("write a time, like `T#{}ms`", constant.text))
                        }
                        None => diagnostic,
                    });
                    None
                }
            },
            (InitialKind::Name(path), Shape::Scalar(scalar)) => {
                let name = path.to_string();
                let value = scalar.enumeration.as_ref().and_then(|values| values.find(&name)).map(|n| n as u64);
                let named = || {
                    let symbol = constants.find(&name)?;
                    let same = symbol.shape.as_ref()?.scalar()?.ty == scalar.ty;
                    constant(symbol).filter(|&n| same && scalar.range.is_none_or(|(l, u)| (l..=u).contains(&n)))
                };
                let value = value.or_else(|| named().map(|number| scalar.ty.pattern(number)));
                if value.is_none() {
                    self.diagnostics.push(unfit(&format!("`{name}`")).help(match scalar.ty.is_bool() {
                        true => "write `TRUE` or `FALSE`, or the name of a constant declared before",
                        false => "write a literal, or the name of a constant declared before",
                    }));
                }
                value.map(Value::Scalar)
            }
            (InitialKind::List(items), Shape::Array { ranges, of }) => {
                let mut parts = Vec::new();
                let mut at: usize = 0;
                for (times, item) in items {
                    let times = usize::try_from(*times).unwrap_or(usize::MAX);
                    if at.saturating_add(times) > elements(ranges) {
                        let message =
                            format!("there are more values than the {} elements of the array", elements(ranges));
                        self.report(Code::InitialValueUnfit, item.span, message, |d| d);
                        return None;
                    }
                    let is_default = matches!(&item.kind, InitialKind::List(inner) if inner.is_empty());
                    let value = if is_default { Value::Default } else { self.value(item, of, constants)? };
                    parts.extend((at..at + times).map(|position| (position, value.clone())));
                    at += times;
                }
                Some(Value::Parts(parts))
            }
            (InitialKind::Structure(given), Shape::Structure(structure)) => {
                let mut parts = Vec::new();
                for (name, value) in given {
                    let found =
                        structure.members.iter().position(|member| member.name.eq_ignore_ascii_case(&name.text));
                    let Some(position) = found else {
                        let message = format!("`{}` has no member `{}`", structure.name, name.text);
                        let names: Vec<&str> = structure.members.iter().map(|member| member.name.as_str()).collect();
                        self.diagnostics
                            .push(Diagnostic::new(Code::MemberUnknown, name.span, message).suggest(&name.text, names));
                        return None;
                    };
                    parts.push((position, self.value(value, &structure.members[position].shape, constants)?));
                }
                Some(Value::Parts(parts))
            }
            (InitialKind::Structure(given), Shape::Instance(id)) => {
                let Some(known) = &self.known else { return Some(Value::Default) };
                let symbols = known[id.0].clone();
                let mut parts = Vec::new();
                for (name, value) in given {
                    parts.push(self.input(name, value, &symbols, constants)?);
                }
                Some(Value::Parts(parts))
            }
            (InitialKind::Constant(constant), _) => {
                let diagnostic = unfit(&format!("`{}`", constant.text));
                self.diagnostics.push(diagnostic.help("write `[1, 2, 3]` for an array, `(a := 1)` for a structure"));
                None
            }
            _ => {
                self.diagnostics.push(unfit("this"));
                None
            }
        }
    }
}

impl Declare<'_> {
    /// The value that an instance's declaration gives one of its variables.
    fn input(&mut self, name: &Name, value: &Initial, symbols: &Symbols, scope: &Scope<'_>) -> Option<(usize, Value)> {
        let is_seen = |symbol: &Symbol| matches!(symbol.section, Section::Input | Section::Output);
        let Some((position, symbol)) = symbols.find(&name.text).filter(|(_, symbol)| is_seen(symbol)) else {
            let message = format!("the function block has no input or output `{}`", name.text);
            let names = symbols.list().iter().filter(|symbol| is_seen(symbol)).map(|symbol| symbol.name.as_str());
            self.diagnostics.push(Diagnostic::new(Code::MemberUnknown, name.span, message).suggest(&name.text, names));
            return None;
        };
        Some((position, self.value(value, symbol.shape.as_ref()?, scope)?))
    }
}

/// The number of a constant's value, if it is known.
fn constant(symbol: &Symbol) -> Option<i128> {
    let scalar = symbol.shape.as_ref()?.scalar()?;
    match symbol.initial {
        Value::Scalar(pattern) if symbol.section == Section::Constant => Some(scalar.ty.number(pattern)),
        _ => None,
    }
}

fn repeated(value: &Value, times: usize) -> Value {
    match value {
        Value::Default => Value::Default,
        given => Value::Parts((0..times).map(|position| (position, given.clone())).collect()),
    }
}

/// How many elementary values a shape has; an instance counts as one.
fn leaves(shape: &Shape) -> usize {
    match shape {
        Shape::Scalar(_) | Shape::Instance(_) => 1,
        Shape::Array { ranges, of } => elements(ranges).saturating_mul(leaves(of)),
        Shape::Structure(structure) => {
            structure.members.iter().fold(0, |sum, member| sum.saturating_add(leaves(&member.shape)))
        }
    }
}

/// Whether a name is that of a value of an enumeration.
pub fn enumerator(enumerations: &[Rc<Enumeration>], name: &str) -> Vec<(Rc<Enumeration>, usize)> {
    enumerations.iter().filter_map(|e| Some((e.clone(), e.find(name)?))).collect()
}
