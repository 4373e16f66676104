//! Calls of function blocks and of functions of the file.

use std::collections::BTreeMap;

use super::Typing;
use super::places::Use;
use crate::semantics::PouId;
use crate::semantics::inference::{Class, NOWHERE};
use crate::semantics::program::{Action, Call, Callee, Condition, Enable, Feed, FeedSource, Place, TypeId};
use crate::semantics::shape::Shape;
use crate::semantics::symbols::{Section, Symbol};
use crate::syntax::ast::{self, Argument, Arguments, Name, Operand, Operator, Path, PouKind};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_base::source::Span;

impl Typing<'_> {
    /// Types a `CAL`, `CALC` or `CALCN`.
    pub fn call(&mut self, condition: Condition, callee: &Path, arguments: &Arguments, span: Span) -> Option<Action> {
        let (id, place) = self.instance(callee)?;
        let mut call = self.empty(condition, Callee::Instance(id, place));
        self.arguments(id, &arguments.list, 0, &mut call);
        self.check_in_outs(id, &call, span);
        Some(Action::Call(Box::new(call)))
    }

    fn empty(&self, condition: Condition, callee: Callee) -> Call {
        let (inputs, in_outs, outputs) = (Vec::new(), Vec::new(), Vec::new());
        let enable = Enable::default();
        Call { condition, callee, result_to: None, inputs, in_outs, outputs, enable, before_eno: 0 }
    }

    /// Resolves the instance of a call. `None` has been reported.
    fn instance(&mut self, path: &Path) -> Option<(PouId, Place)> {
        if let Some(name) = path.plain()
            && self.context.project.variable(self.context.id, &name.text).is_none()
            && self.context.project.find(&name.text).is_some()
        {
            let message = format!("`{}` is no instance of a function block", name.text);
            let id = self.context.project.find(&name.text)?;
            let help = match self.context.project.pou(id).kind {
                PouKind::FunctionBlock => {
                    format!("declare one, like `VAR x : {}; END_VAR`, and call it with `CAL x`", name.text)
                }
                PouKind::Function => format!("functions are called by their name alone: `{}`", name.text),
                PouKind::Program => "a program is executed by its task, and cannot be called".to_owned(),
            };
            self.diagnostics.push(Diagnostic::new(Code::NotCallable, name.span, message).help(help));
            return None;
        }
        let place = self.place(path, Use::Read)?;
        match place.shape {
            Shape::Instance(id) => Some((id, place)),
            _ => {
                let message = format!("`{path}` is `{}`, not an instance of a function block", place.shape);
                self.diagnostics.push(Diagnostic::new(Code::NotCallable, path.span, message));
                None
            }
        }
    }

    /// Types `S1 x`, `CLK x`, …: the current result becomes an input, and the instance is called.
    pub fn input_operator(&mut self, operator: Operator, path: &Path, span: Span, result: TypeId) -> Option<Action> {
        let (id, place) = self.instance(path)?;
        let word = operator.verb.word();
        let symbols = self.context.project.symbols(id);
        let block = self.context.project.pou(id).name.text.clone();
        let Some((position, symbol)) = symbols.find(word).filter(|(_, symbol)| symbol.section == Section::Input) else {
            let inputs = inputs_of(symbols.list()).map(|symbol| symbol.name.as_str()).collect::<Vec<_>>().join(", ");
            let message = format!("`{block}` has no input `{word}`");
            self.diagnostics
                .push(Diagnostic::new(Code::ParameterUnknown, span, message).help(format!("its inputs are {inputs}")));
            return None;
        };
        let scalar = self.whole(symbol, word, span)?;
        let ty = self.types.of(&scalar, NOWHERE);
        self.same(result, ty, span, |known| {
            format!("the input `{word}` of `{block}` is `{scalar}`, but the current result is `{}`", known.scalar)
        });
        let mut call = self.empty(Condition::Always, Callee::Instance(id, place));
        call.result_to = Some((position, ty));
        self.check_in_outs(id, &call, span);
        Some(Action::Call(Box::new(call)))
    }

    /// Types the call of a function by its name: one of the file, or a standard one.
    pub fn function(
        &mut self,
        name: &Name,
        arguments: &Arguments,
        span: Span,
        result: TypeId,
    ) -> (Option<Action>, TypeId) {
        let own = self.context.project.find(&name.text);
        match own.map(|id| (id, self.context.project.pou(id).kind)) {
            Some((id, PouKind::Function)) => {
                let value = self.result_of(id, span);
                (self.own_function(id, arguments, span, result), value)
            }
            Some((_, kind)) => {
                let message = format!("`{}` is a `{kind}`, not a function", name.text);
                let help = match kind {
                    PouKind::FunctionBlock => {
                        format!("declare an instance, like `VAR x : {}; END_VAR`, and call it with `CAL x`", name.text)
                    }
                    _ => "a program is executed by its task, and cannot be called".to_owned(),
                };
                self.diagnostics.push(Diagnostic::new(Code::NotCallable, name.span, message).help(help));
                (None, self.types.fresh())
            }
            None => self.standard(name, arguments, span, result),
        }
    }

    /// Type of the result of a function.
    fn result_of(&mut self, id: PouId, span: Span) -> TypeId {
        let symbols = self.context.project.symbols(id).list();
        let result = symbols.iter().find(|symbol| symbol.section == Section::Result);
        match result.and_then(|symbol| symbol.shape.as_ref()?.scalar()) {
            Some(scalar) => self.types.of(scalar, span),
            None => self.types.fresh(),
        }
    }

    fn own_function(&mut self, id: PouId, arguments: &Arguments, span: Span, result: TypeId) -> Option<Action> {
        let mut call = self.empty(Condition::Always, Callee::Function(id));
        let symbols = self.context.project.symbols(id).list();
        let name = &self.context.project.pou(id).name.text;
        let mut first = 0;
        if !arguments.enclosed {
            let inputs: Vec<(usize, &Symbol)> = positional(symbols).collect();
            let Some(&(position, input)) = inputs.first() else {
                let message = format!("`{name}` has no inputs, so it cannot take the current result");
                let help = format!("write `{name}()`");
                self.diagnostics.push(Diagnostic::new(Code::ParameterCount, span, message).help(help));
                return None;
            };
            first = 1;
            if input.section == Section::InOut {
                let message = format!("`{}` is an in-out variable of `{name}`, so it needs a variable", input.name);
                let help = format!("the current result is none; write `{name}({} := x)`", input.name);
                self.diagnostics.push(Diagnostic::new(Code::ParameterUnfit, span, message).help(help));
                return None;
            }
            let scalar = self.whole(input, &input.name, span)?;
            let ty = self.types.of(&scalar, NOWHERE);
            self.same(result, ty, span, |known| {
                format!(
                    "the first input `{}` of `{name}` is `{scalar}`, but the current result is `{}`",
                    input.name, known.scalar
                )
            });
            call.inputs.push((position, Feed { ty, source: FeedSource::Result, span }));
            if arguments.list.len() + 1 != inputs.len() {
                let names: Vec<&str> = inputs.iter().map(|(_, symbol)| symbol.name.as_str()).collect();
                let (has, given) = (plural(inputs.len(), "input"), arguments.list.len() + 1);
                let message =
                    format!("`{name}` has {has}, but {given} {} given", if given == 1 { "is" } else { "are" });
                self.diagnostics.push(Diagnostic::new(Code::ParameterCount, span, message).help(format!(
                    "its inputs are {}; the first is the current result, the others stand behind the name",
                    names.join(", ")
                )));
                return None;
            }
        }
        self.arguments(id, &arguments.list, first, &mut call);
        self.check_in_outs(id, &call, span);
        Some(Action::Call(Box::new(call)))
    }

    /// Assigns arguments to the variables of a unit; positional ones begin with the input at position `first`.
    fn arguments(&mut self, id: PouId, arguments: &[Argument], first: usize, call: &mut Call) {
        let context = self.context;
        let symbols = context.project.symbols(id);
        let block = &context.project.pou(id).name.text;
        let inputs: Vec<(usize, &Symbol)> = positional(symbols.list()).collect();
        let mut given: BTreeMap<String, Span> = BTreeMap::new();
        let mut next = first;
        for argument in arguments {
            let (name, at) = match argument {
                Argument::Positional(operand) => match inputs.get(next) {
                    Some((_, symbol)) => (symbol.name.clone(), operand.span()),
                    None => {
                        let message = format!("`{block}` has only {}", plural(inputs.len(), "input"));
                        self.diagnostics.push(Diagnostic::new(Code::ParameterCount, operand.span(), message));
                        return;
                    }
                },
                Argument::Input { name, .. } | Argument::Output { name, .. } => (name.text.clone(), name.span),
            };
            next += usize::from(matches!(argument, Argument::Positional(_)));
            if let Some(earlier) = given.insert(ast::key(&name), at) {
                let message = format!("the parameter `{name}` is given twice");
                self.diagnostics
                    .push(Diagnostic::new(Code::ParameterTwice, at, message).also(earlier, "first given here"));
                continue;
            }
            self.argument(id, argument, &name, at, call);
        }
    }

    fn argument(&mut self, id: PouId, argument: &Argument, name: &str, at: Span, call: &mut Call) -> Option<()> {
        let context = self.context;
        let symbols = context.project.symbols(id);
        let block = &context.project.pou(id).name.text;
        let Some((position, symbol)) = symbols.find(name) else {
            if self.enable(argument, name, &mut call.enable) {
                if matches!(argument, Argument::Output { .. }) {
                    call.before_eno = call.outputs.len();
                }
                return Some(());
            }
            let message = format!("`{block}` has no parameter `{name}`");
            let names = parameters(symbols.list()).map(|symbol| symbol.name.as_str());
            let list = names.clone().collect::<Vec<_>>().join(", ");
            self.diagnostics.push(
                Diagnostic::new(Code::ParameterUnknown, at, message)
                    .suggest(name, names)
                    .help(format!("its parameters are {list}")),
            );
            return None;
        };
        let unfit = |message: String, help: &str| Diagnostic::new(Code::ParameterUnfit, at, message).help(help);
        match (argument, symbol.section) {
            (Argument::Output { negated, target, .. }, Section::Output) => {
                let shape = symbol.shape.as_ref()?;
                let Some(scalar) = shape.scalar().cloned() else {
                    let message = format!("the output `{name}` is {shape}, and cannot be taken as one value");
                    let help = "load its parts after the call, or declare it in `VAR_IN_OUT`";
                    self.diagnostics.push(unfit(message, help));
                    return None;
                };
                let (ty, place) = self.writable(target, "=>")?;
                let own = self.types.of(&scalar, NOWHERE);
                self.same(own, ty, place.span, |_| {
                    format!("the output `{name}` of `{block}` is `{scalar}`, and this is of another type")
                });
                if *negated {
                    self.types.demand(own, Class::Bits, at, "NOT");
                }
                call.outputs.push((position, *negated, place));
            }
            (Argument::Output { .. }, _) => {
                let message = format!("`{name}` is no output of `{block}`");
                self.diagnostics.push(unfit(message, "only outputs are taken with `=>`; inputs are given with `:=`"));
            }
            (Argument::Input { .. } | Argument::Positional(_), Section::Input) => {
                let scalar = self.whole(symbol, name, at)?;
                let feed = match argument {
                    Argument::Input { value, .. } => self.given(value, at)?,
                    Argument::Positional(operand) | Argument::Output { target: operand, .. } => self.feed(operand)?,
                };
                self.input(&scalar, &feed, name, block);
                call.inputs.push((position, feed));
            }
            (Argument::Input { .. } | Argument::Positional(_), Section::InOut) => {
                let (Argument::Input { value: ast::Feed::Operand(Operand::Variable(path)), .. }
                | Argument::Positional(Operand::Variable(path))) = argument
                else {
                    let message = format!("`{name}` is an in-out variable of `{block}`, so it needs a variable");
                    self.diagnostics
                        .push(unfit(message, &format!("`{block}` writes to it, so name a variable of your own")));
                    return None;
                };
                let place = self.place(path, Use::Bind)?;
                let shape = symbol.shape.as_ref()?;
                if !place.shape.same(shape) {
                    let message = format!(
                        "the in-out variable `{name}` of `{block}` is `{shape}`, but this is `{}`",
                        place.shape
                    );
                    self.diagnostics.push(Diagnostic::new(Code::TypesDiffer, path.span, message));
                    return None;
                }
                call.in_outs.push((position, place));
            }
            (_, Section::Output) => {
                let message = format!("`{name}` is an output of `{block}`");
                self.diagnostics
                    .push(unfit(message, &format!("take it with `{name} => x`, or load it after the call")));
            }
            _ => {
                let message = format!("`{name}` is no parameter of `{block}`");
                self.diagnostics.push(unfit(message, "only inputs, outputs and in-out variables are handed over"));
            }
        }
        Some(())
    }

    /// Scalar of an input; reports an input that is not an elementary value.
    fn whole(&mut self, symbol: &Symbol, name: &str, at: Span) -> Option<crate::semantics::shape::Scalar> {
        let shape = symbol.shape.as_ref()?;
        if shape.scalar().is_none() {
            let message = format!("the input `{name}` is {shape}, and cannot be handed over as one value");
            let help = "declare it in `VAR_IN_OUT`";
            self.diagnostics.push(Diagnostic::new(Code::ParameterUnfit, at, message).help(help));
        }
        shape.scalar().cloned()
    }

    fn input(&mut self, scalar: &crate::semantics::shape::Scalar, feed: &Feed, name: &str, block: &str) {
        let ty = self.types.of(scalar, NOWHERE);
        self.same(ty, feed.ty, feed.span, |_| {
            format!("the input `{name}` of `{block}` is `{scalar}`, and this is of another type")
        });
    }

    /// Value for an input: an operand, or the result of a list. `None` has been reported.
    pub fn given(&mut self, value: &ast::Feed, span: Span) -> Option<Feed> {
        match value {
            ast::Feed::Operand(operand) => self.feed(operand),
            ast::Feed::List(list) => {
                let undefined = self.types.fresh();
                let (statements, ty) = self.sequence(list, undefined);
                Some(Feed { ty, source: FeedSource::List(statements), span })
            }
        }
    }

    /// Types `EN := …` and `ENO => …`, which every unit has; returns whether the argument is one of these.
    pub fn enable(&mut self, argument: &Argument, name: &str, enable: &mut Enable) -> bool {
        match argument {
            Argument::Input { name: Name { span: argument_span, .. }, value } if name.eq_ignore_ascii_case("EN") => {
                if let Some(feed) = self.given(value, *argument_span) {
                    let boolean = self.types.boolean(NOWHERE);
                    self.same(boolean, feed.ty, feed.span, |_| "`EN` is a `BOOL`".to_owned());
                    enable.en = Some(feed);
                }
                true
            }
            Argument::Output { negated, target, .. } if name.eq_ignore_ascii_case("ENO") => {
                if let Some((ty, place)) = self.writable(target, "=>") {
                    let boolean = self.types.boolean(NOWHERE);
                    self.same(boolean, ty, place.span, |_| "`ENO` is a `BOOL`".to_owned());
                    enable.eno = Some((*negated, place));
                }
                true
            }
            _ => false,
        }
    }

    /// Reports missing in-out variables: each stands for a variable of the caller.
    fn check_in_outs(&mut self, id: PouId, call: &Call, span: Span) {
        let symbols = self.context.project.symbols(id).list();
        for (position, symbol) in symbols.iter().enumerate().filter(|(_, symbol)| symbol.section == Section::InOut) {
            if !call.in_outs.iter().any(|(given, _)| *given == position) {
                let block = &self.context.project.pou(id).name.text;
                // Diagnostics of this very call are the latest ones.
                let mut latest = self.diagnostics.iter().rev().take(100);
                let known = latest.any(|d| d.span().start >= span.start && d.span().end <= span.end);
                if !known {
                    let message = format!("the in-out variable `{}` of `{block}` is not given", symbol.name);
                    let help = format!("give it a variable, like `{} := x`", symbol.name);
                    self.diagnostics.push(Diagnostic::new(Code::ParameterCount, span, message).help(help));
                }
            }
        }
    }
}

/// `1 input`, `2 inputs`
pub fn plural(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

fn inputs_of(symbols: &[Symbol]) -> impl Iterator<Item = &Symbol> {
    symbols.iter().filter(|symbol| symbol.section == Section::Input)
}

/// Parameters that may be given by position: inputs and in-out variables, in the order of declaration.
fn positional(symbols: &[Symbol]) -> impl Iterator<Item = (usize, &Symbol)> {
    symbols.iter().enumerate().filter(|(_, symbol)| matches!(symbol.section, Section::Input | Section::InOut))
}

fn parameters(symbols: &[Symbol]) -> impl Iterator<Item = &Symbol> + Clone {
    symbols.iter().filter(|symbol| matches!(symbol.section, Section::Input | Section::InOut | Section::Output))
}
