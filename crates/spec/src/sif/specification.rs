//! Specification of a safety system: signals, functions, zones and restrictions, with all names resolved.

use fixedbitset::FixedBitSet;

use super::formula::{Formula, SignalId};
use petril_base::source::Span;

/// Specification, read from one or several files.
#[derive(Clone, Debug, Default)]
pub struct Specification {
    /// Name of the system.
    pub title: Option<String>,
    /// Groups of functions.
    pub zones: Vec<Zone>,
    /// Inputs, outputs and auxiliary values.
    pub signals: Vec<Signal>,
    /// Functions in the order of the files.
    pub functions: Vec<Function>,
    /// Restrictions on inputs.
    pub restrictions: Vec<Restriction>,
    /// Definitions in topological order: each after those it uses.
    pub order: Vec<SignalId>,
}

/// Group of functions, with a name and possibly a title.
#[derive(Clone, Debug)]
pub struct Zone {
    /// Name.
    pub name: String,
    /// Title.
    pub title: Option<String>,
}

/// A safety instrumented function, in the three sections of the seed paper's template.
#[derive(Clone, Debug)]
pub struct Function {
    /// Name.
    pub name: String,
    /// Title.
    pub title: Option<String>,
    /// Position of its zone among the zones.
    pub zone: Option<usize>,
    /// Section 1: informal properties, as pairs of a word and a text: `sil`, `3`.
    pub informal: Vec<(String, String)>,
    /// Section 2: inputs listed; some may be outputs of other functions.
    pub inputs: Vec<SignalId>,
    /// Section 2: outputs.
    pub outputs: Vec<SignalId>,
    /// Section 3: definitions, outputs and auxiliary values, in the order in which they are written.
    pub equations: Vec<SignalId>,
    /// Place of the declaration.
    pub place: Place,
}

/// Boolean signal.
#[derive(Clone, Debug)]
pub struct Signal {
    /// Name as first written; that of an auxiliary value begins with its function: `F1.Trigger`.
    pub name: String,
    /// Description in plain language.
    pub description: Option<String>,
    /// Binding to the program.
    pub binding: Option<Binding>,
    /// Origin of the value.
    pub kind: Kind,
    /// Place of the declaration, or of the definition if not declared.
    pub place: Place,
}

/// Origin of a signal's value.
#[derive(Clone, Debug)]
pub enum Kind {
    /// Input from outside.
    Input {
        /// Value at rest: when no demand is present.
        rest: bool,
    },
    /// Value computed by a function.
    Defined {
        /// Position of the function.
        function: usize,
        /// Defining formula.
        formula: Formula,
        /// Whether the signal is an output; else an auxiliary value.
        is_output: bool,
        /// Reset condition of the latch, if the signal is latched; the formula has priority.
        latched: Option<Formula>,
        /// On-delay in milliseconds.
        delayed: Option<u32>,
        /// Place of the equation.
        place: Place,
    },
}

/// Binding of a signal to the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Binding {
    /// Variable of this name: `is Valve`.
    Variable(String, Place),
    /// Variable located at this address: `at %IX0.0`.
    Address(String, Place),
}

/// Restriction on inputs.
#[derive(Clone, Debug)]
pub struct Restriction {
    /// Name.
    pub name: String,
    /// Sentence given by the author.
    pub sentence: Option<String>,
    /// Scope.
    pub scope: Scope,
    /// Formula that every allowed valuation satisfies.
    pub allowed: Formula,
    /// Text as written, on one line, without the name.
    pub text: String,
    /// Place of the declaration.
    pub place: Place,
}

/// Scope of a restriction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// The whole system.
    System,
    /// Functions of a zone.
    Zone(usize),
    /// A function.
    Function(usize),
}

/// Place in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Position of the file among those read.
    pub file: usize,
    /// Byte range.
    pub span: Span,
}

impl Specification {
    /// A signal.
    #[must_use]
    pub fn signal(&self, id: SignalId) -> &Signal {
        &self.signals[id.0]
    }

    /// The name of a signal.
    #[must_use]
    pub fn name(&self, id: SignalId) -> &str {
        &self.signals[id.0].name
    }

    /// Defining formula of a signal; `None` for an input.
    #[must_use]
    pub fn definition(&self, id: SignalId) -> Option<&Formula> {
        match &self.signals[id.0].kind {
            Kind::Input { .. } => None,
            Kind::Defined { formula, .. } => Some(formula),
        }
    }

    /// Signals that a signal is computed from or reset by, in the order in which the formulas mention them; empty for
    /// an input.
    #[must_use]
    pub fn uses(&self, id: SignalId) -> Vec<SignalId> {
        match &self.signals[id.0].kind {
            Kind::Input { .. } => Vec::new(),
            Kind::Defined { formula, latched, .. } => {
                formula.signals().into_iter().chain(latched.iter().flat_map(Formula::signals)).collect()
            }
        }
    }

    /// Text of a formula.
    #[must_use]
    pub fn text(&self, formula: &Formula) -> String {
        formula.text(&|signal| self.name(signal))
    }

    /// Inputs in the order of declaration.
    pub fn inputs(&self) -> impl Iterator<Item = SignalId> {
        let is_input = |id: &SignalId| matches!(self.signals[id.0].kind, Kind::Input { .. });
        (0..self.signals.len()).map(SignalId).filter(is_input)
    }

    /// Outputs of all functions, in the order of the functions.
    pub fn outputs(&self) -> impl Iterator<Item = SignalId> {
        self.functions.iter().flat_map(|function| function.outputs.iter().copied())
    }

    /// Value of an input at rest; FALSE for other signals.
    #[must_use]
    pub fn rest(&self, id: SignalId) -> bool {
        matches!(self.signals[id.0].kind, Kind::Input { rest: true })
    }

    /// Restrictions that apply to a function: its own, its zone's, and the system's.
    pub fn restrictions_of(&self, function: usize) -> impl Iterator<Item = &Restriction> {
        let zone = self.functions[function].zone;
        self.restrictions.iter().filter(move |restriction| match restriction.scope {
            Scope::System => true,
            Scope::Zone(of) => Some(of) == zone,
            Scope::Function(of) => of == function,
        })
    }

    /// The set of these signals. All sets of signals have the capacity for all signals.
    #[must_use]
    pub fn valuation(&self, ones: impl IntoIterator<Item = SignalId>) -> FixedBitSet {
        let mut set = FixedBitSet::with_capacity(self.signals.len());
        ones.into_iter().for_each(|signal| set.insert(signal.0));
        set
    }

    /// Computes the definitions from the inputs, on 64 valuations at once: one word per signal.
    pub fn settle(&self, words: &mut [u64]) {
        for &id in &self.order {
            if let Some(formula) = self.definition(id) {
                words[id.0] = formula.evaluate(&|signal| words[signal.0]);
            }
        }
    }

    /// Computes the definitions in any number of valuations.
    pub fn settle_all(&self, valuations: &mut [FixedBitSet]) {
        for batch in valuations.chunks_mut(64) {
            let mut words = vec![0_u64; self.signals.len()];
            for (bit, valuation) in batch.iter().enumerate() {
                valuation.ones().for_each(|id| words[id] |= 1 << bit);
            }
            self.settle(&mut words);
            for (bit, valuation) in batch.iter_mut().enumerate() {
                words.iter().enumerate().for_each(|(id, word)| valuation.set(id, word >> bit & 1 == 1));
            }
        }
    }

    /// Signals that are TRUE for these inputs. A latched or delayed signal has the value of its formula.
    #[must_use]
    pub fn settled(&self, inputs: &FixedBitSet) -> FixedBitSet {
        let mut words: Vec<u64> = (0..self.signals.len()).map(|id| u64::from(inputs.contains(id))).collect();
        self.settle(&mut words);
        self.valuation((0..words.len()).filter(|id| words[*id] & 1 == 1).map(SignalId))
    }
}
