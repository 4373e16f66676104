//! Resolution of declarations to shapes and values at power-on.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::initial::Constants;
use super::shape::{Enumeration, Member, PouId, Scalar, Shape, Structure, Value, elements};
use super::symbols::Symbols;
use crate::syntax::ast::{Literal, Name, Range, TypeDeclaration, TypeSpec};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;
use petril_base::{Kind, Type};

/// Maximum number of elementary values of a variable, and of values of an enumeration.
const MAX_ELEMENTS: usize = 1 << 16;

/// Maximum nesting depth of types, through all their names. The limit keeps recursion over types within its stack.
const MAX_DEPTH: usize = 100;

/// Types of a file, with everything else that a declaration may name.
pub struct Declare<'a> {
    declared: BTreeMap<String, &'a TypeDeclaration>,
    resolved: BTreeMap<String, Option<(Shape, Value)>>,
    open: Vec<String>,
    blocks: &'a BTreeMap<String, PouId>,
    /// Every enumeration, for the names of its values.
    pub enumerations: Vec<Rc<Enumeration>>,
    pub diagnostics: Vec<Diagnostic>,
    /// Variables of the units, once they are known.
    pub known: Option<Vec<Symbols>>,
    /// Whether the variables of the units were needed before they were known.
    pub needs_units: bool,
}

impl<'a> Declare<'a> {
    /// Resolves the types of a file; `blocks` are the existing function blocks, `known` the variables of all units,
    /// once they have been read.
    pub fn new(types: &'a [TypeDeclaration], blocks: &'a BTreeMap<String, PouId>, known: Option<Vec<Symbols>>) -> Self {
        let mut declare = Self {
            declared: BTreeMap::new(),
            resolved: BTreeMap::new(),
            open: Vec::new(),
            blocks,
            enumerations: Vec::new(),
            diagnostics: Vec::new(),
            known,
            needs_units: false,
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

    pub fn report(&mut self, code: Code, span: Span, message: String, more: impl FnOnce(Diagnostic) -> Diagnostic) {
        self.diagnostics.push(more(Diagnostic::new(code, span, message)));
    }

    /// Shape that a type specification stands for, and value of its variables at power-on. `None` has been reported.
    pub fn shape(&mut self, spec: &TypeSpec, constants: Constants<'_>) -> Option<(Shape, Value)> {
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
                    let is_small = |&(lower, upper): &(i64, i64)| {
                        // Keeps lengths and distances from overflowing.
                        lower.unsigned_abs().max(upper.unsigned_abs()) < 1 << 62 && upper - lower < MAX_ELEMENTS as i64
                    };
                    numbers.extend(whole.filter(is_small));
                }
                let (of, initial) = self.shape(of, constants)?;
                let count = numbers.iter().try_fold(of.leaves(), |n, (lower, upper)| {
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
                let shape = Shape::Array { ranges: numbers, of: Box::new(of) };
                self.not_too_deep(&shape, *span)?;
                Some((shape, initial))
            }
            TypeSpec::Structure { members, span } => self.structure("a structure", members, *span, constants),
        }
    }

    fn structure(
        &mut self,
        name: &str,
        declarations: &[crate::syntax::ast::Declaration],
        span: Span,
        constants: Constants<'_>,
    ) -> Option<(Shape, Value)> {
        let mut members: Vec<Member> = Vec::new();
        let mut names = BTreeSet::new();
        for declaration in declarations {
            let (shape, default) = self.shape(declaration.spec.as_ref()?, constants)?;
            let initial = match &declaration.initial {
                Some(initial) => self.value(initial, &shape, constants)?,
                None => default,
            };
            for name in &declaration.names {
                if !names.insert(name.key()) {
                    let message = format!("the member `{}` is declared twice", name.text);
                    self.report(Code::NameDeclaredTwice, name.span, message, |d| d);
                    continue;
                }
                members.push(Member { name: name.text.clone(), shape: shape.clone(), initial: initial.clone() });
            }
        }
        let structure = Structure::new(name.to_owned(), members);
        if structure.leaves > MAX_ELEMENTS {
            let message = format!("this structure has more than {MAX_ELEMENTS} values");
            let help = "every value becomes places of the net; make the structure as large as the program needs it";
            self.report(Code::VariableTooLarge, span, message, |d| d.help(help));
            return None;
        }
        let shape = Shape::Structure(Rc::new(structure));
        self.not_too_deep(&shape, span)?;
        Some((shape, Value::Default))
    }

    fn not_too_deep(&mut self, shape: &Shape, span: Span) -> Option<()> {
        if shape.depth() > MAX_DEPTH {
            self.too_deep(span);
            return None;
        }
        Some(())
    }

    fn too_deep(&mut self, span: Span) {
        let message = format!("types are nested more than {MAX_DEPTH} deep here");
        self.report(Code::VariableTooLarge, span, message, |d| d.help("declare a flatter type"));
    }

    fn enumeration(&mut self, name: Option<&str>, values: &[Name]) -> Option<(Shape, Value)> {
        let mut known: BTreeMap<String, Span> = BTreeMap::new();
        for value in values {
            if let Some(&first) = known.get(&value.key()) {
                let message = format!("the value `{}` is named twice", value.text);
                self.report(Code::NameDeclaredTwice, value.span, message, |d| d.also(first, "first named here"));
            } else {
                known.insert(value.key(), value.span);
            }
        }
        if let Some(first) = values.get(MAX_ELEMENTS) {
            let message = format!("this enumeration has more than {MAX_ELEMENTS} values");
            self.report(Code::VariableTooLarge, first.span, message, |d| d.here("one too many"));
            return None;
        }
        let values: Vec<String> = values.iter().map(|value| value.text.clone()).collect();
        let name = name.map_or_else(|| format!("({})", values.join(", ")), str::to_owned);
        let enumeration = Rc::new(Enumeration { name, values: values.into() });
        self.enumerations.push(enumeration.clone());
        Some((Shape::Scalar(Scalar::enumerated(enumeration)), Value::Default))
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
        if self.open.contains(&key) {
            let message = format!("the type `{}` contains itself", name.text);
            self.report(Code::TypeRecursive, name.span, message, |d| {
                d.also(declaration.name.span, "declared here")
                    .help("refer to another one by a number, like its index in an array")
            });
            return None;
        }
        if self.open.len() == MAX_DEPTH {
            self.too_deep(name.span);
            return None;
        }
        self.open.push(key.clone());
        let resolved = self.declaration(declaration);
        self.open.pop();
        self.resolved.insert(key, resolved.clone());
        resolved
    }

    fn declaration(&mut self, declaration: &TypeDeclaration) -> Option<(Shape, Value)> {
        let none = Constants::none();
        let (mut shape, default) = match declaration.spec.as_ref()? {
            TypeSpec::Enumeration(values) => self.enumeration(Some(&declaration.name.text), values)?,
            TypeSpec::Structure { members, span } => self.structure(&declaration.name.text, members, *span, none)?,
            other => self.shape(other, none)?,
        };
        let value = match &declaration.initial {
            Some(initial) => self.value(initial, &shape, none)?,
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

    /// Bounds of a range, which is not empty. `None` has been reported.
    fn range(&mut self, range: &Range, constants: Constants<'_>) -> Option<(i128, i128)> {
        let mut end = |bound: &Name| {
            let number = match Literal::read(&bound.text) {
                Some(Literal::Integer(number) | Literal::Typed(_, number)) => Some(number),
                _ => constants.number(&bound.text).map(|(number, _)| number),
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
}

fn repeated(value: &Value, times: usize) -> Value {
    match value {
        Value::Default => Value::Default,
        given => Value::Parts([(0..times, given.clone())].into()),
    }
}

/// Enumerations that have a value with this name, with its number.
pub fn enumerator(enumerations: &[Rc<Enumeration>], name: &str) -> Vec<(Rc<Enumeration>, usize)> {
    enumerations.iter().filter_map(|e| Some((e.clone(), e.find(name)?))).collect()
}
