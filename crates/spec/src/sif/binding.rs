//! Binding of signals to variables of a program.

use fixedbitset::FixedBitSet;

use super::formula::SignalId;
use super::specification::{Binding, Kind, Place, Specification};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_lang::flat::FlatProgram;
use petril_lang::semantics::{Role, VarId};

/// Diagnostic in a file of a specification, given by the file's position.
pub type Located = (usize, Diagnostic);

/// Resolves signals to variables: by `is NAME`, by `at %IX0.0`, or by their own name. Diagnostics are collected until
/// the end.
#[derive(Debug)]
pub struct Binder<'a> {
    specification: &'a Specification,
    program: &'a FlatProgram,
    /// Signal bound to each variable.
    signals: Vec<Option<SignalId>>,
    /// Variable of each signal requested.
    variables: Vec<Option<VarId>>,
    /// Signals requested, so that each is diagnosed once.
    asked: FixedBitSet,
    found: Vec<Located>,
}

impl<'a> Binder<'a> {
    /// Starts without bindings.
    #[must_use]
    pub fn new(specification: &'a Specification, program: &'a FlatProgram) -> Self {
        let (signals, variables) = (vec![None; program.variables.len()], vec![None; specification.signals.len()]);
        let asked = FixedBitSet::with_capacity(specification.signals.len());
        Self { specification, program, signals, variables, asked, found: Vec::new() }
    }

    /// Variables of the signals requested.
    ///
    /// # Errors
    /// Signals whose variable is missing or unsuitable.
    pub fn finish(self) -> Result<Vec<Option<VarId>>, Vec<Located>> {
        if self.found.is_empty() { Ok(self.variables) } else { Err(self.found) }
    }

    /// The variable of a signal, if the program has it. A missing variable is not an error unless the signal has an
    /// explicit binding: the signal may belong to another program.
    pub fn bind_if_there(&mut self, id: SignalId) -> Option<VarId> {
        let signal = self.specification.signal(id);
        let is_elsewhere = signal.binding.is_none() && self.program.find(&signal.name).is_none();
        if is_elsewhere { None } else { self.bind(id) }
    }

    /// The variable of a signal; `None` if a diagnostic has been added.
    pub fn bind(&mut self, id: SignalId) -> Option<VarId> {
        if self.asked.put(id.0) {
            return self.variables[id.0];
        }
        let signal = self.specification.signal(id);
        let is_input = matches!(signal.kind, Kind::Input { .. });
        let (variable, written, place) = match &signal.binding {
            None => (self.program.find(&signal.name), &signal.name, signal.place),
            Some(Binding::Variable(name, place)) => (self.program.find(name), name, *place),
            Some(Binding::Address(address, place)) => (self.program.at(address), address, *place),
        };
        let Some(variable) = variable else {
            let what = if is_input { "input" } else { "output" };
            let message = match signal.binding {
                Some(Binding::Address(..)) => format!("the program has no variable at `{written}`"),
                _ => format!("the program has no variable `{written}`"),
            };
            let known = self.program.declared().map(|id| self.program.variable(id).name.as_str());
            let diagnostic = Diagnostic::new(Code::SifVariableUnknown, place.span, message)
                .suggest_at(self.found.len(), written, known)
                .help(format!("say which variable the {what} `{}` stands for: `is NAME` or `at %IX0.0`", signal.name));
            return self.report(place, diagnostic);
        };
        let declared = self.program.variable(variable);
        let unfit = if !declared.ty.is_bool() {
            Some((format!("is of type {}", declared.ty), "a signal stands for a variable of type BOOL"))
        } else if is_input && declared.role != Role::Input {
            Some(("is no input of the program".to_owned(), "an input stands for a variable in VAR_INPUT or at `%I…`"))
        } else if !is_input && matches!(declared.role, Role::Input | Role::Constant) {
            let what = if declared.role == Role::Input { "an input of the program" } else { "a constant" };
            Some((format!("is {what}"), "an output stands for a variable that the program writes"))
        } else {
            None
        };
        if let Some((what, help)) = unfit {
            let message = format!("`{}` {what}", declared.name);
            return self.report(place, Diagnostic::new(Code::SifVariableUnfit, place.span, message).help(help));
        }
        if let Some(other) = self.signals[variable.0].replace(id) {
            let (other, name) = (self.specification.name(other), &declared.name);
            let message = format!("`{}` and `{other}` both stand for `{name}`", signal.name);
            let diagnostic = Diagnostic::new(Code::SifVariableShared, place.span, message);
            return self.report(place, diagnostic.help("use one name for both, or say which variable each stands for"));
        }
        self.variables[id.0] = Some(variable);
        Some(variable)
    }

    fn report(&mut self, place: Place, diagnostic: Diagnostic) -> Option<VarId> {
        self.found.push((place.file, diagnostic));
        None
    }
}
