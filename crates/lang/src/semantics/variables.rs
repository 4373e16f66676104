//! Symbols from blocks of variables (B.1.4.3).

use super::address;
use super::declare::Declare;
use super::initial::Constants;
use super::shape::{Shape, Value};
use super::symbols::{Section, Symbol, Symbols};
use crate::syntax::ast::{Declaration, Name, Pou, PouKind, TypeSpec, VarBlock, VarKind};
use petril_base::diagnostic::{Code, Diagnostic};

/// Reads the symbols that a unit declares.
pub fn of_unit(pou: &Pou, globals: &Symbols, declare: &mut Declare<'_>) -> Symbols {
    let mut variables = Variables {
        symbols: Symbols::default(),
        globals,
        may_locate: pou.kind == PouKind::Program,
        in_function: pou.kind == PouKind::Function,
        declare,
    };
    if pou.kind == PouKind::Function {
        variables.result(pou);
    }
    pou.blocks.iter().for_each(|block| variables.block(block));
    variables.symbols
}

/// Reads the global variables that blocks declare.
pub fn global(blocks: &[VarBlock], declare: &mut Declare<'_>) -> Symbols {
    let globals = &Symbols::default();
    let mut variables =
        Variables { symbols: Symbols::default(), globals, may_locate: true, in_function: false, declare };
    blocks.iter().for_each(|block| variables.block(block));
    variables.symbols
}

/// Symbols of a unit while its declarations are read.
struct Variables<'v, 'd> {
    symbols: Symbols,
    globals: &'v Symbols,
    /// Whether a variable may have an address.
    may_locate: bool,
    in_function: bool,
    declare: &'v mut Declare<'d>,
}

impl Variables<'_, '_> {
    fn push(&mut self, diagnostic: Diagnostic) {
        self.declare.diagnostics.push(diagnostic);
    }

    /// Adds the result of a function, a variable with its name.
    fn result(&mut self, pou: &Pou) {
        let report = |message: String, help: &str| {
            let span = pou.result.as_ref().map_or(pou.name.span, |result| result.span);
            Diagnostic::new(Code::FunctionResult, span, message).help(help)
        };
        let shape = match &pou.result {
            None => {
                let message = format!("the function `{}` has no result type", pou.name.text);
                let help = format!("write it behind the name, like `FUNCTION {} : INT`", pou.name.text);
                self.push(report(message, &help));
                None
            }
            Some(result) => {
                let shape = self.declare.shape(&TypeSpec::Named(result.clone()), Constants::none());
                let shape = shape.map(|(shape, _)| shape);
                if let Some(shape) = shape.as_ref().filter(|shape| shape.scalar().is_none()) {
                    let message = format!("a function cannot return {shape}");
                    self.push(report(message, "return one elementary value, and the others by `VAR_OUTPUT`"));
                }
                shape.filter(|shape| shape.scalar().is_some())
            }
        };
        let _ = self.symbols.add(Symbol {
            name: pou.name.text.clone(),
            span: pou.name.span,
            section: Section::Result,
            shape,
            initial: Value::Default,
            is_given: false,
            location: None,
        });
    }

    fn block(&mut self, block: &VarBlock) {
        if let Some(diagnostic) = unsupported(block) {
            self.push(diagnostic);
        }
        if let Some(word) = block.retain.as_ref().filter(|word| !word.is("NON_RETAIN")) {
            let message = format!("`{}` variables are modelled as after a cold start", word.key());
            let help =
                "every variable begins with its initial value; values kept over a loss of power are not explored";
            self.push(Diagnostic::new(Code::RetainColdStart, word.span, message).help(help));
        }
        block.declarations.iter().for_each(|declaration| self.declaration(declaration, block));
    }

    fn declaration(&mut self, declaration: &Declaration, block: &VarBlock) {
        let constants = Constants::of(&self.symbols, self.globals);
        let shaped = declaration.spec.as_ref().and_then(|spec| self.declare.shape(spec, constants));
        let value = match (&declaration.initial, &shaped) {
            (Some(initial), Some((shape, _))) => self.declare.value(initial, shape, constants),
            (_, Some((_, default))) => Some(default.clone()),
            (_, None) => None,
        };
        if let Some(edge) = &declaration.edge {
            let message = format!("`{}` is not supported", edge.key());
            let help = "declare an instance of R_TRIG or F_TRIG, and call it with the input";
            self.push(Diagnostic::new(Code::DeclarationNotSupported, edge.span, message).help(help));
        }
        let misplaced =
            shaped.as_ref().and_then(|(shape, _)| misplaced_instance(declaration, block, shape, self.in_function));
        self.declare.diagnostics.extend(misplaced);
        for name in &declaration.names {
            let section = self.section(name, block);
            let mut symbol = Symbol {
                name: name.text.clone(),
                span: name.span,
                section,
                shape: shaped.as_ref().map(|(shape, _)| shape.clone()),
                initial: value.clone().unwrap_or(Value::Default),
                is_given: declaration.initial.is_some(),
                location: None,
            };
            if let Section::External(position) = section {
                self.external(&mut symbol, position);
            }
            if let Some(location) = &declaration.location {
                match address::fit(location, &symbol, self.may_locate || block.kind == VarKind::Global) {
                    Ok(location) => symbol.location = Some(location),
                    Err(diagnostic) => self.push(diagnostic),
                }
            }
            self.add(symbol, declaration);
        }
    }

    /// Section of a variable in a block.
    fn section(&mut self, name: &Name, block: &VarBlock) -> Section {
        match block.kind {
            VarKind::Input => Section::Input,
            VarKind::Output => Section::Output,
            VarKind::InOut => Section::InOut,
            VarKind::Temp => Section::Temp,
            VarKind::External => match self.globals.find(&name.text) {
                Some((position, _)) => Section::External(position),
                None => {
                    let message = format!("there is no global variable `{}`", name.text);
                    let diagnostic = Diagnostic::new(Code::ExternalWithoutGlobal, name.span, message)
                        .suggest(&name.text, self.globals.names())
                        .help(
                            "declare it in `VAR_GLOBAL`, in this file outside of all programs or in its configuration",
                        );
                    self.push(diagnostic);
                    Section::External(usize::MAX)
                }
            },
            _ if block.constant => Section::Constant,
            _ => Section::Local,
        }
    }

    /// Checks that an external variable has the type of the global one.
    fn external(&mut self, symbol: &mut Symbol, position: usize) {
        let Some(global) = self.globals.list().get(position) else { return };
        let (Some(own), Some(other)) = (&symbol.shape, &global.shape) else { return };
        if !own.same(other) {
            let message = format!("`{}` is `{own}` here, but the global variable is `{other}`", symbol.name);
            self.push(Diagnostic::new(Code::TypesDiffer, symbol.span, message).also(global.span, "declared here"));
            symbol.shape = None;
        }
    }

    fn add(&mut self, symbol: Symbol, declaration: &Declaration) {
        let (span, name) = (symbol.span, symbol.name.clone());
        let Err(first) = self.symbols.add(symbol) else { return };
        // In a declaration that cannot be read, it is not known which words are names.
        if declaration.spec.is_some() {
            let first = &self.symbols.list()[first];
            let what = match first.section {
                Section::Result => "the function's result is declared here",
                _ => "first declared here",
            };
            let diagnostic = Diagnostic::new(Code::NameDeclaredTwice, span, format!("`{name}` is declared twice"))
                .here("declared again")
                .also(first.span, what)
                .help("remove or rename one of them");
            self.push(diagnostic);
        }
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

/// Reports an instance of a function block, which keeps its state, where variables are initialised at each call or
/// copied.
fn misplaced_instance(
    declaration: &Declaration,
    block: &VarBlock,
    shape: &Shape,
    in_function: bool,
) -> Option<Diagnostic> {
    let why = match block.kind {
        _ if shape.instances().is_empty() => return None,
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
