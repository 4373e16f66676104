//! Name resolution: [`Written`] to [`Specification`], with definitions in order and all errors.
//!
//! Names are case-insensitive, as in IL. Inputs, outputs and functions have global scope, auxiliary values that of
//! their function.

mod in_order;

use std::collections::HashMap;

use super::formula::{Formula, SignalId};
use super::parse::parse;
use super::specification::{Binding, Function, Kind, Place, Restriction, Scope, Signal, Specification, Zone};
use super::written::{Name, Written, WrittenBinding, WrittenFunction, WrittenInput, WrittenRestriction};
use petril_base::diagnostic::{Code, Diagnostic, any_error};
use petril_base::source::Source;
use petril_lang::syntax::ast::key;

impl Specification {
    /// Reads files as one specification, with the diagnostics of each; `None` if any diagnostic is an error.
    #[must_use]
    pub fn read(sources: &[Source]) -> (Option<Self>, Vec<Vec<Diagnostic>>) {
        let (written, diagnostics): (Vec<Written>, Vec<Vec<Diagnostic>>) = sources.iter().map(parse).unzip();
        let broken = diagnostics.iter().any(|list| any_error(list));
        let (functions, zones) = (Vec::new(), Vec::new());
        let mut resolver = Resolver {
            sources,
            specification: Self::default(),
            names: HashMap::new(),
            own: HashMap::new(),
            rests: HashMap::new(),
            functions,
            zones,
            diagnostics,
            is_quiet: broken,
        };
        resolver.resolve(&written);
        let Resolver { specification, diagnostics, .. } = resolver;
        let usable = !diagnostics.iter().any(|list| any_error(list));
        (usable.then_some(specification), diagnostics)
    }
}

/// Resolution under way.
struct Resolver<'s> {
    sources: &'s [Source],
    specification: Specification,
    /// Inputs and outputs by name.
    names: HashMap<String, SignalId>,
    /// Auxiliary values by function and name.
    own: HashMap<(usize, String), SignalId>,
    /// Rest values given explicitly.
    rests: HashMap<SignalId, bool>,
    /// For each file, the position of its first function among all.
    functions: Vec<usize>,
    /// For each file, the positions of its zones among all.
    zones: Vec<Vec<usize>>,
    diagnostics: Vec<Vec<Diagnostic>>,
    /// Whether a file could not be read completely, so that a missing declaration may be in the unread part.
    is_quiet: bool,
}

impl Resolver<'_> {
    fn resolve(&mut self, written: &[Written]) {
        for (file, written) in written.iter().enumerate() {
            self.frame(file, written);
        }
        for (file, written) in written.iter().enumerate() {
            for (position, function) in written.functions.iter().enumerate() {
                self.define(file, self.functions[file] + position, function);
            }
        }
        for (file, written) in written.iter().enumerate() {
            for input in &written.inputs {
                self.input(file, input);
            }
        }
        for (file, written) in written.iter().enumerate() {
            for (position, function) in written.functions.iter().enumerate() {
                self.formulas(file, self.functions[file] + position, function);
            }
            for restriction in &written.restrictions {
                self.restriction(file, restriction);
            }
        }
        if self.specification.functions.is_empty() && !self.is_quiet {
            let message = "this specification has no function";
            let help = "a function is like `function F1 \"what it is for\" { interface { … } formal { … } }`";
            let at = Place::default();
            self.report(at, Diagnostic::new(Code::SifNotDefined, at.span, message).help(help));
        }
        // An unknown name is a dummy signal.
        if !self.diagnostics.iter().any(|list| any_error(list)) {
            self.put_in_order();
        }
    }

    fn report(&mut self, at: Place, diagnostic: Diagnostic) {
        if let Some(list) = self.diagnostics.get_mut(at.file) {
            list.push(diagnostic);
        }
    }

    /// Adds a second place, which may be in another file.
    fn with(&self, diagnostic: Diagnostic, from: Place, to: Place, text: &str) -> Diagnostic {
        if from.file == to.file {
            return diagnostic.also(to.span, text);
        }
        let source = &self.sources[to.file];
        let (line, column) = source.line_column(to.span.start);
        diagnostic.help(format!("{text}: {}:{line}:{column}", source.name()))
    }

    /// Declares the title, the zones, and the functions without their contents.
    fn frame(&mut self, file: usize, written: &Written) {
        for title in &written.titles {
            if self.specification.title.is_some() {
                let diagnostic = Diagnostic::new(Code::SifNameTwice, title.span, "the system has a second title");
                self.report(Place { file, span: title.span }, diagnostic.help("leave one out"));
            } else {
                self.specification.title = Some(title.text.clone());
            }
        }
        let mut zones = Vec::new();
        for (name, title) in &written.zones {
            // A zone may be continued, in this file or another.
            let known = self.specification.zones.iter().position(|zone| key(&zone.name) == key(&name.text));
            let zone = known.unwrap_or_else(|| {
                self.specification.zones.push(Zone { name: name.text.clone(), title: None });
                self.specification.zones.len() - 1
            });
            let of = &mut self.specification.zones[zone].title;
            *of = of.take().or_else(|| title.clone());
            zones.push(zone);
        }
        self.functions.push(self.specification.functions.len());
        for function in &written.functions {
            let place = Place { file, span: function.name.span };
            let same = |other: &&Function| key(&other.name) == key(&function.name.text);
            if let Some(first) = self.specification.functions.iter().find(same) {
                let message = format!("there are two functions named `{}`", function.name.text);
                let diagnostic = Diagnostic::new(Code::SifNameTwice, place.span, message);
                let diagnostic = self.with(diagnostic, place, first.place, "the first is here");
                self.report(place, diagnostic.help("give each a name of its own"));
            }
            self.specification.functions.push(Function {
                name: function.name.text.clone(),
                title: function.title.clone(),
                zone: function.zone.map(|zone| zones[zone]),
                informal: function.informal.clone(),
                inputs: Vec::new(),
                outputs: Vec::new(),
                equations: Vec::new(),
                place,
            });
        }
        self.zones.push(zones);
    }

    /// Declares the outputs and auxiliary values of a function, without their formulas.
    fn define(&mut self, file: usize, of: usize, function: &WrittenFunction) {
        for output in &function.outputs {
            let place = Place { file, span: output.name.span };
            if self.is_taken(&output.name, place) {
                continue;
            }
            let defined = |(name, _): &&(Name, Formula<Name>)| key(&name.text) == key(&output.name.text);
            let equation = function.equations.iter().find(defined);
            if equation.is_none() && !self.is_quiet {
                let message = format!("output `{}` has no equation", output.name.text);
                let help = format!("say in the section `formal` what it is: `{} = …;`", output.name.text);
                self.report(place, Diagnostic::new(Code::SifNotDefined, place.span, message).help(help));
            }
            let at = equation.map_or(place, |(name, _)| Place { file, span: name.span });
            let kind = Kind::Defined {
                function: of,
                formula: Formula::Constant(false),
                is_output: true,
                latched: None,
                delayed: output.delayed,
                place: at,
            };
            let (name, description) = (output.name.text.clone(), output.description.clone());
            let binding = output.binding.as_ref().map(|binding| bound(binding, file));
            let id = self.add(Signal { name, description, binding, kind, place });
            self.names.insert(key(&output.name.text), id);
            self.specification.functions[of].outputs.push(id);
        }
        let mut defined: HashMap<String, Place> = HashMap::new();
        for (name, _) in &function.equations {
            let place = Place { file, span: name.span };
            if let Some(first) = defined.insert(key(&name.text), place) {
                let message = format!("`{}` has a second equation", name.text);
                let diagnostic = Diagnostic::new(Code::SifNameTwice, place.span, message);
                let diagnostic = self.with(diagnostic, place, first, "the first is here");
                self.report(place, diagnostic.help("join both by an operator, or give each a name of its own"));
                continue;
            }
            let known = self.names.get(&key(&name.text)).copied();
            if let Some(id) = known.filter(|id| self.specification.functions[of].outputs.contains(id)) {
                self.specification.functions[of].equations.push(id);
                continue;
            }
            let kind = Kind::Defined {
                function: of,
                formula: Formula::Constant(false),
                is_output: false,
                latched: None,
                delayed: None,
                place,
            };
            let full = format!("{}.{}", function.name.text, name.text);
            let id = self.add(Signal { name: full, description: None, binding: None, kind, place });
            self.own.insert((of, key(&name.text)), id);
            self.specification.functions[of].equations.push(id);
        }
        if function.outputs.is_empty() && !self.is_quiet {
            let place = Place { file, span: function.name.span };
            let message = format!("function `{}` has no output", function.name.text);
            let help = "declare what it gives in the section `interface`: `output NAME \"what it is\";`";
            self.report(place, Diagnostic::new(Code::SifNotDefined, place.span, message).help(help));
        }
    }

    /// Whether the name of an output is taken; reported if so.
    fn is_taken(&mut self, name: &Name, place: Place) -> bool {
        let Some(&first) = self.names.get(&key(&name.text)) else { return false };
        let message = format!("`{}` is an output already", name.text);
        let diagnostic = Diagnostic::new(Code::SifNameTwice, place.span, message);
        let diagnostic = self.with(diagnostic, place, self.specification.signal(first).place, "the first is here");
        self.report(place, diagnostic.help("one function defines an output; others use it by its name"));
        true
    }

    fn add(&mut self, signal: Signal) -> SignalId {
        self.specification.signals.push(signal);
        SignalId(self.specification.signals.len() - 1)
    }

    /// Declares an input: a new one, a known one, or the output of another function.
    fn input(&mut self, file: usize, input: &WrittenInput) {
        let place = Place { file, span: input.name.span };
        let function = input.function.map(|function| self.functions[file] + function);
        let binding = input.binding.as_ref().map(|binding| bound(binding, file));
        if let Some(own) = function.and_then(|of| self.own.get(&(of, key(&input.name.text)))).copied() {
            let message = format!("input `{}` has an equation", input.name.text);
            let diagnostic = Diagnostic::new(Code::SifNotDefinable, place.span, message);
            let diagnostic = self.with(diagnostic, place, self.specification.signal(own).place, "it is defined here");
            self.report(place, diagnostic.help("declare it as an output, or leave the equation out"));
            return;
        }
        let id = match self.names.get(&key(&input.name.text)).copied() {
            None => {
                let kind = Kind::Input { rest: input.rest.unwrap_or(false) };
                let (name, description) = (input.name.text.clone(), input.description.clone());
                let id = self.add(Signal { name, description, binding, kind, place });
                self.names.insert(key(&input.name.text), id);
                self.rests.extend(input.rest.map(|rest| (id, rest)));
                id
            }
            Some(id) => {
                self.agree(id, input, binding, place, function);
                id
            }
        };
        if let Some(of) = function
            && !self.specification.functions[of].inputs.contains(&id)
        {
            self.specification.functions[of].inputs.push(id);
        }
    }

    /// Merges a further declaration of a signal; reports a contradiction.
    fn agree(&mut self, id: SignalId, input: &WrittenInput, binding: Option<Binding>, place: Place, of: Option<usize>) {
        let outputs = of.map(|of| self.specification.functions[of].outputs.contains(&id));
        let rest = input.rest.map(|rest| *self.rests.entry(id).or_insert(rest));
        let signal = &mut self.specification.signals[id.0];
        let first = signal.place;
        let same = |a: &Binding, b: &Binding| match (a, b) {
            (Binding::Variable(a, _), Binding::Variable(b, _)) | (Binding::Address(a, _), Binding::Address(b, _)) => {
                key(a) == key(b)
            }
            _ => false,
        };
        let contradiction = match (&mut signal.kind, &signal.binding, &binding) {
            (Kind::Defined { .. }, ..) if outputs == Some(true) => Some("an input and an output of one function"),
            (Kind::Defined { .. }, ..) if input.rest.is_some() => {
                Some("an output of another function; it has no rest value")
            }
            (_, Some(old), Some(new)) if !same(old, new) => Some("something else in the program"),
            (Kind::Input { .. }, ..) if rest != input.rest => {
                Some(if rest == Some(true) { "TRUE at rest" } else { "FALSE at rest" })
            }
            (Kind::Input { rest: at_rest }, ..) => {
                *at_rest = rest.unwrap_or(*at_rest);
                None
            }
            _ => None,
        };
        signal.binding = signal.binding.take().or(binding);
        signal.description = signal.description.take().or_else(|| input.description.clone());
        if let Some(already) = contradiction {
            let message = format!("`{}` is {already} already", input.name.text);
            let diagnostic = Diagnostic::new(Code::SifDeclaredDifferently, place.span, message);
            let diagnostic = self.with(diagnostic, place, first, "it was declared here");
            let help = "one name is one signal in the whole specification: let the declarations agree, or rename one";
            self.report(place, diagnostic.help(help));
        }
    }

    /// Resolves the formulas of a function.
    fn formulas(&mut self, file: usize, of: usize, function: &WrittenFunction) {
        for (name, written) in &function.equations {
            let name = key(&name.text);
            let known = self.own.get(&(of, name.clone())).or_else(|| self.names.get(&name)).copied();
            let resolved = self.formula(file, Some(of), written);
            let own = known.filter(|id| self.specification.functions[of].equations.contains(id));
            if let Some(Kind::Defined { formula, .. }) = own.map(|id| &mut self.specification.signals[id.0].kind) {
                *formula = resolved;
            }
        }
        for output in &function.outputs {
            let Some(reset) = &output.latched else { continue };
            let reset = self.formula(file, Some(of), reset);
            let id = self.names.get(&key(&output.name.text)).copied();
            if let Some(Kind::Defined { latched, .. }) = id.map(|id| &mut self.specification.signals[id.0].kind) {
                *latched = Some(reset);
            }
        }
    }

    fn restriction(&mut self, file: usize, written: &WrittenRestriction) {
        let place = Place { file, span: written.name.span };
        let function = written.function.map(|function| self.functions[file] + function);
        let zone = written.zone.map(|zone| self.zones[file][zone]);
        let scope = match (function, zone) {
            (Some(function), _) => Scope::Function(function),
            (None, Some(zone)) => Scope::Zone(zone),
            (None, None) => Scope::System,
        };
        let same = |other: &&Restriction| {
            let meets = other.scope == scope || scope == Scope::System || other.scope == Scope::System;
            meets && key(&other.name) == key(&written.name.text)
        };
        if let Some(first) = self.specification.restrictions.iter().find(same) {
            let message = format!("there are two restrictions named `{}`", written.name.text);
            let diagnostic = Diagnostic::new(Code::SifNameTwice, place.span, message);
            let diagnostic = self.with(diagnostic, place, first.place, "the first is here");
            self.report(place, diagnostic.help("give each a name of its own"));
        }
        let allowed = self.formula(file, function, &written.allowed);
        let (name, sentence, text) = (written.name.text.clone(), written.sentence.clone(), written.text.clone());
        self.specification.restrictions.push(Restriction { name, sentence, scope, allowed, text, place });
    }

    /// Resolves the names of a formula; unknown names are reported.
    fn formula(&mut self, file: usize, of: Option<usize>, written: &Formula<Name>) -> Formula {
        let mut unknown = Vec::new();
        let formula = written.map(&mut |name| {
            let own = of.and_then(|of| self.own.get(&(of, key(&name.text))));
            own.or_else(|| self.names.get(&key(&name.text))).copied().unwrap_or_else(|| {
                unknown.push(name.clone());
                SignalId(0)
            })
        });
        if self.is_quiet {
            return formula;
        }
        for (position, name) in unknown.into_iter().enumerate() {
            let message = format!("there is no signal `{}`", name.text);
            let of_function = of.map(|of| self.specification.functions[of].name.clone() + ".");
            let known: Vec<&str> = self.specification.signals.iter().map(|signal| signal.name.as_str()).collect();
            let known =
                known.iter().map(|name| of_function.as_ref().and_then(|of| name.strip_prefix(of)).unwrap_or(name));
            let diagnostic = Diagnostic::new(Code::SifNameUnknown, name.span, message)
                .suggest_at(position, &name.text, known)
                .help("declare it in a section `interface`, or define it by an equation");
            self.report(Place { file, span: name.span }, diagnostic);
        }
        formula
    }
}

fn bound(binding: &WrittenBinding, file: usize) -> Binding {
    match binding {
        WrittenBinding::Variable(name) => Binding::Variable(name.text.clone(), Place { file, span: name.span }),
        WrittenBinding::Address(name) => Binding::Address(name.text.clone(), Place { file, span: name.span }),
    }
}
