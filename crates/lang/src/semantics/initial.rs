//! Initial values, written after `:=` in a declaration.

use super::constant::{number, wider};
use super::declare::Declare;
use super::shape::{Shape, Value, elements};
use super::symbols::{Section, Symbol, Symbols};
use crate::syntax::ast::{Initial, InitialKind, Literal, Name};
use petril_base::Type;
use petril_base::diagnostic::{Code, Diagnostic};

/// Constants that a declaration may name: those of its unit, and global ones.
#[derive(Clone, Copy, Default)]
pub struct Constants<'s> {
    own: Option<&'s Symbols>,
    global: Option<&'s Symbols>,
}

impl<'s> Constants<'s> {
    /// No constants, as in the declarations of types.
    pub fn none() -> Self {
        Self::default()
    }

    pub fn of(own: &'s Symbols, global: &'s Symbols) -> Self {
        Self { own: Some(own), global: Some(global) }
    }

    /// Number of a constant, if it is known, and its type.
    pub fn number(self, name: &str) -> Option<(i128, Type)> {
        let (_, symbol) = [self.own, self.global].into_iter().flatten().find_map(|symbols| symbols.find(name))?;
        constant(symbol)
    }
}

impl Declare<'_> {
    /// Reads the initial value of a variable of this shape. `None` has been reported.
    pub fn value(&mut self, initial: &Initial, shape: &Shape, constants: Constants<'_>) -> Option<Value> {
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
                    let fits = |&n: &i128| scalar.range.is_none_or(|(lower, upper)| (lower..=upper).contains(&n));
                    constants.number(&name).filter(|(_, ty)| *ty == scalar.ty).map(|(number, _)| number).filter(fits)
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
                    parts.push((at..at + times, value));
                    at += times;
                }
                Some(Value::Parts(parts.into()))
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
                    let value = self.value(value, &structure.members[position].shape, constants)?;
                    parts.push((position..position + 1, value));
                }
                Some(Value::Parts(parts.into()))
            }
            (InitialKind::Structure(given), Shape::Instance(id)) => {
                let Some(known) = &self.known else {
                    self.needs_units = true;
                    return Some(Value::Default);
                };
                let symbols = known[id.0].clone();
                let mut parts = Vec::new();
                for (name, value) in given {
                    let (position, value) = self.input(name, value, &symbols, constants)?;
                    parts.push((position..position + 1, value));
                }
                Some(Value::Parts(parts.into()))
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
    /// Reads the initial value that an instance's declaration gives one of its variables.
    fn input(
        &mut self,
        name: &Name,
        value: &Initial,
        symbols: &Symbols,
        constants: Constants<'_>,
    ) -> Option<(usize, Value)> {
        let is_seen = |symbol: &Symbol| matches!(symbol.section, Section::Input | Section::Output);
        let Some((position, symbol)) = symbols.find(&name.text).filter(|(_, symbol)| is_seen(symbol)) else {
            let message = format!("the function block has no input or output `{}`", name.text);
            let names = symbols.list().iter().filter(|symbol| is_seen(symbol)).map(|symbol| symbol.name.as_str());
            self.diagnostics.push(Diagnostic::new(Code::MemberUnknown, name.span, message).suggest(&name.text, names));
            return None;
        };
        Some((position, self.value(value, symbol.shape.as_ref()?, constants)?))
    }
}

fn constant(symbol: &Symbol) -> Option<(i128, Type)> {
    let scalar = symbol.shape.as_ref()?.scalar()?;
    match symbol.initial {
        Value::Scalar(pattern) if symbol.section == Section::Constant => Some((scalar.ty.number(pattern), scalar.ty)),
        _ => None,
    }
}
