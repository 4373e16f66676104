//! Typing of calls of standard functions (2.5.1.5), which take values of many types.

use super::Typing;
use super::calls::plural;
use super::operators;
use crate::semantics::function::Function;
use crate::semantics::inference::{Class, NOWHERE};
use crate::semantics::program::{Action, Enable, Feed, FeedSource, Standard, StandardFunction, TypeId};
use crate::semantics::shape::Scalar;
use crate::syntax::ast::{Argument, Arguments, Name, Verb, key};
use crate::syntax::standard_operator;
use petril_base::Type;
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

/// Signature of a standard function: the function and the names of its inputs. The last name is repeated with a number
/// after it if `many`.
struct Signature {
    function: StandardFunction,
    inputs: &'static [&'static str],
    many: bool,
}

/// Standard functions with values or arguments of types that are not modelled.
const UNSUPPORTED: [&str; 29] = [
    "SQRT",
    "LN",
    "LOG",
    "EXP",
    "SIN",
    "COS",
    "TAN",
    "ASIN",
    "ACOS",
    "ATAN",
    "EXPT",
    "TRUNC",
    "LEN",
    "LEFT",
    "RIGHT",
    "MID",
    "CONCAT",
    "INSERT",
    "DELETE",
    "REPLACE",
    "FIND",
    "ADD_TIME",
    "SUB_TIME",
    "MULTIME",
    "DIVTIME",
    "ADR",
    "SIZEOF",
    "TIME",
    "ADD_TOD_TIME",
];

impl Typing<'_> {
    pub fn standard(
        &mut self,
        name: &Name,
        arguments: &Arguments,
        span: Span,
        result: TypeId,
    ) -> (Option<Action>, TypeId) {
        let word = name.key();
        if let Some((from, to)) = conversion(&word) {
            return self.conversion(name, (from, to), arguments, span, result);
        }
        let Some(signature) = signature(&word) else {
            self.unknown_function(name);
            return (None, self.types.fresh());
        };
        let mut enable = Enable::default();
        let Some(feeds) = self.standard_arguments(name, &signature, arguments, span, result, &mut enable) else {
            return (None, self.types.fresh());
        };
        let value = match (signature.function, self.demands(name, signature.function, &feeds, span)) {
            (StandardFunction::Chain(_), _) => self.types.boolean(span),
            (_, value) => value,
        };
        let standard = Standard { function: signature.function, ty: value, arguments: feeds, enable };
        (Some(Action::Standard(Box::new(standard))), value)
    }

    fn conversion(
        &mut self,
        name: &Name,
        (from, to): (Type, Type),
        arguments: &Arguments,
        span: Span,
        result: TypeId,
    ) -> (Option<Action>, TypeId) {
        let signature = Signature { function: StandardFunction::Convert, inputs: &["IN"], many: false };
        let mut enable = Enable::default();
        let value = self.types.of(&Scalar::new(to), span);
        let Some(feeds) = self.standard_arguments(name, &signature, arguments, span, result, &mut enable) else {
            return (None, value);
        };
        let own = self.types.of(&Scalar::new(from), NOWHERE);
        self.same(own, feeds[0].ty, feeds[0].span, |_| {
            format!("`{}` takes `{from}`, and this is of another type", name.text)
        });
        let standard = Standard { function: StandardFunction::Convert, ty: value, arguments: feeds, enable };
        (Some(Action::Standard(Box::new(standard))), value)
    }

    /// Arguments in the order of the function's inputs. `None` has been reported.
    fn standard_arguments(
        &mut self,
        name: &Name,
        signature: &Signature,
        arguments: &Arguments,
        span: Span,
        result: TypeId,
        enable: &mut Enable,
    ) -> Option<Vec<Feed>> {
        let mut feeds: Vec<Option<Feed>> = Vec::new();
        if !arguments.enclosed {
            feeds.push(Some(Feed { ty: result, source: FeedSource::Result, span }));
        }
        let errors = self.diagnostics.len();
        // Undeclared names are reported later.
        let mut broken = false;
        for argument in &arguments.list {
            match argument {
                Argument::Positional(operand) => {
                    let feed = self.feed(operand);
                    broken |= feed.is_none();
                    feeds.push(feed);
                }
                Argument::Input { name: input, value } => {
                    if self.enable(argument, &input.text, enable) {
                        continue;
                    }
                    let Some(position) = position(&input.key(), signature) else {
                        self.unknown_input(name, input, signature);
                        continue;
                    };
                    if feeds.get(position).is_some_and(Option::is_some) {
                        let message = format!("the parameter `{}` is given twice", input.text);
                        self.diagnostics.push(Diagnostic::new(Code::ParameterTwice, input.span, message));
                        continue;
                    }
                    let feed = self.given(value, input.span);
                    broken |= feed.is_none();
                    if feeds.len() <= position {
                        feeds.resize_with(position + 1, || None);
                    }
                    feeds[position] = feed;
                }
                Argument::Output { name: output, .. } => {
                    if !self.enable(argument, &output.text, enable) {
                        self.unknown_input(name, output, signature);
                    }
                }
            }
        }
        if broken || self.diagnostics.len() > errors {
            return None;
        }
        let needed = signature.inputs.len();
        let fits = if signature.many { feeds.len() >= needed } else { feeds.len() == needed };
        if !fits || feeds.iter().any(Option::is_none) {
            let given = feeds.iter().flatten().count();
            let least = if signature.many { "at least " } else { "" };
            let (takes, verb) = (plural(needed, "value"), if given == 1 { "is" } else { "are" });
            let message = format!("`{}` takes {least}{takes}, but {given} {verb} given", name.text);
            let list = signature.inputs.join(", ") + if signature.many { ", …" } else { "" };
            let help = match arguments.enclosed {
                true => format!("they are {list}"),
                false => format!("they are {list}; the first is the current result, the others stand behind the name"),
            };
            self.diagnostics.push(Diagnostic::new(Code::ParameterCount, span, message).help(help));
            return None;
        }
        Some(feeds.into_iter().flatten().collect())
    }

    fn unknown_input(&mut self, name: &Name, input: &Name, signature: &Signature) {
        let message = format!("`{}` has no parameter `{}`", name.text, input.text);
        let list = signature.inputs.join(", ") + if signature.many { ", …" } else { "" };
        self.diagnostics.push(
            Diagnostic::new(Code::ParameterUnknown, input.span, message)
                .suggest(&input.text, signature.inputs.iter().copied())
                .help(format!("its parameters are {list}")),
        );
    }

    /// Adds the constraints of a function on the types of its arguments; returns the type of its value.
    fn demands(&mut self, name: &Name, function: StandardFunction, feeds: &[Feed], span: Span) -> TypeId {
        let alike = |typing: &mut Self, feeds: &[Feed]| {
            for feed in feeds.iter().skip(1) {
                typing.same(feeds[0].ty, feed.ty, feed.span, |known| {
                    format!("`{}` needs values of one type, and the first is `{}`", name.text, known.scalar)
                });
            }
            feeds[0].ty
        };
        let word = &name.text;
        match function {
            StandardFunction::Convert | StandardFunction::Move => feeds[0].ty,
            StandardFunction::Not => {
                self.types.demand(feeds[0].ty, Class::Bits, span, word);
                feeds[0].ty
            }
            StandardFunction::Abs => {
                self.types.demand(feeds[0].ty, Class::Integers, span, word);
                feeds[0].ty
            }
            StandardFunction::Min | StandardFunction::Max | StandardFunction::Limit => {
                let ty = alike(self, feeds);
                self.types.demand(ty, Class::Ordered, span, word);
                ty
            }
            StandardFunction::Sel => {
                let boolean = self.types.boolean(NOWHERE);
                self.same(boolean, feeds[0].ty, feeds[0].span, |_| format!("`{word}` chooses by a `BOOL`"));
                alike(self, &feeds[1..])
            }
            StandardFunction::Mux => {
                self.types.demand(feeds[0].ty, Class::Integers, feeds[0].span, word);
                alike(self, &feeds[1..])
            }
            StandardFunction::Fold(function) if function.shifts() => {
                self.types.demand(feeds[0].ty, Class::Bits, span, word);
                self.types.demand(feeds[1].ty, Class::Integers, feeds[1].span, word);
                feeds[0].ty
            }
            StandardFunction::Fold(function) | StandardFunction::Chain(function) => {
                let ty = alike(self, feeds);
                self.demand(function, ty, span, word);
                ty
            }
        }
    }

    fn unknown_function(&mut self, name: &Name) {
        let word = name.key();
        if UNSUPPORTED.contains(&word.as_str()) || names_unsupported_type(&word) {
            let message = format!("the standard function `{}` is not supported", name.text);
            let help = "functions of integers, bits and times are; real numbers, strings and dates are not modelled";
            self.diagnostics.push(Diagnostic::new(Code::StandardNotSupported, name.span, message).help(help));
            return;
        }
        let context = self.context;
        if let Some((_, _, symbol)) = context.project.variable(context.id, &name.text) {
            let message = format!("`{}` is a variable, not an instruction", name.text);
            let help = match symbol.shape {
                Some(crate::semantics::Shape::Instance(_)) => format!("call it with `CAL {}`", name.text),
                _ => format!("load it with `LD {}`, or store in it with `ST {0}`", name.text),
            };
            self.diagnostics.push(Diagnostic::new(Code::UnknownOperator, name.span, message).help(help));
            return;
        }
        let own = context.project.unit.pous.iter().map(|pou| pou.name.text.as_str());
        let message = format!("`{}` is neither an operator nor a function that is known", name.text);
        let diagnostic = Diagnostic::new(Code::UnknownOperator, name.span, message);
        if let Some(standard) = standard_operator(&name.text) {
            let help = format!("`{}` is Siemens Statement List; in Instruction List it is `{standard}`", name.text);
            self.diagnostics.push(diagnostic.help(help));
            return;
        }
        let position = self.unknown_words;
        self.unknown_words += 1;
        self.diagnostics.push(diagnostic.suggest_at(position, &name.text, WORDS.iter().copied().chain(own)));
    }
}

/// Words that an instruction can begin with.
const WORDS: [&str; 41] = [
    "LD", "LDN", "ST", "STN", "S", "R", "NOT", "AND", "ANDN", "OR", "ORN", "XOR", "XORN", "&", "ADD", "SUB", "MUL",
    "DIV", "MOD", "GT", "GE", "EQ", "NE", "LE", "LT", "JMP", "JMPC", "JMPCN", "RET", "RETC", "RETCN", "CAL", "CALC",
    "CALCN", "ABS", "MIN", "MAX", "LIMIT", "SEL", "MUX", "MOVE",
];

/// Whether a word in capital letters is the name of a standard function.
pub fn is_standard(word: &str) -> bool {
    conversion(word).is_some() || signature(word).is_some()
}

/// Position of an input of a formal call, by its name.
fn position(name: &str, signature: &Signature) -> Option<usize> {
    if let Some(position) = signature.inputs.iter().position(|input| *input == name) {
        return Some(position);
    }
    let last = signature.inputs.last()?;
    let (stem, number) = last.split_at(last.find(|c: char| c.is_ascii_digit())?);
    let first: usize = number.parse().ok()?;
    let number: usize = name.strip_prefix(stem)?.parse().ok()?;
    let beyond = number.checked_sub(first)?;
    (signature.many && number < 10_000).then_some(signature.inputs.len() - 1 + beyond)
}

fn signature(word: &str) -> Option<Signature> {
    let of = |function, inputs, many| Some(Signature { function, inputs, many });
    match word {
        "MOVE" => of(StandardFunction::Move, &["IN"], false),
        "NOT" => of(StandardFunction::Not, &["IN"], false),
        "ABS" => of(StandardFunction::Abs, &["IN"], false),
        "MIN" => of(StandardFunction::Min, &["IN1", "IN2"], true),
        "MAX" => of(StandardFunction::Max, &["IN1", "IN2"], true),
        "LIMIT" => of(StandardFunction::Limit, &["MN", "IN", "MX"], false),
        "SEL" => of(StandardFunction::Sel, &["G", "IN0", "IN1"], false),
        "MUX" => of(StandardFunction::Mux, &["K", "IN0", "IN1"], true),
        "SHL" => of(StandardFunction::Fold(Function::Shl), &["IN", "N"], false),
        "SHR" => of(StandardFunction::Fold(Function::Shr), &["IN", "N"], false),
        "ROL" => of(StandardFunction::Fold(Function::Rol), &["IN", "N"], false),
        "ROR" => of(StandardFunction::Fold(Function::Ror), &["IN", "N"], false),
        _ => {
            let &(verb, _) = Verb::ALL.iter().find(|(verb, own)| *own == word && verb.combines())?;
            let function = operators::function(verb)?;
            match function {
                Function::Ne => of(StandardFunction::Chain(function), &["IN1", "IN2"], false),
                _ if function.compares() => of(StandardFunction::Chain(function), &["IN1", "IN2"], true),
                Function::Sub | Function::Div | Function::Mod => {
                    of(StandardFunction::Fold(function), &["IN1", "IN2"], false)
                }
                _ => of(StandardFunction::Fold(function), &["IN1", "IN2"], true),
            }
        }
    }
}

/// Types in a conversion function's name, like `INT_TO_BYTE`.
fn conversion(word: &str) -> Option<(Type, Type)> {
    let (from, to) = word.split_once("_TO_")?;
    Some((Type::named(from)?, Type::named(to)?))
}

/// Whether a word is a conversion from or to a type that is not modelled, like `INT_TO_REAL`.
fn names_unsupported_type(word: &str) -> bool {
    const TYPES: [&str; 10] = ["REAL", "LREAL", "STRING", "WSTRING", "DATE", "TOD", "DT", "BCD", "LTIME", "DINT"];
    let known = |name: &str| TYPES.contains(&name) || Type::named(name).is_some();
    match word.split_once("_TO_") {
        Some((from, to)) => known(from) && known(to),
        None => word.starts_with("TRUNC") || key(word).contains("BCD_TO"),
    }
}
