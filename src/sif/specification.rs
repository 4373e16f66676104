//! What a safety system has to compute: signals, functions, zones and restrictions, with all names resolved.

use fixedbitset::FixedBitSet;

use super::formula::{Formula, SignalId};
use petril_base::source::Span;

/// A whole specification, of one file or several.
#[derive(Clone, Debug, Default)]
pub struct Specification {
    /// What the system is called.
    pub title: Option<String>,
    /// Groups of functions.
    pub zones: Vec<Zone>,
    /// Inputs, outputs and auxiliary values.
    pub signals: Vec<Signal>,
    /// The functions in the order of the files.
    pub functions: Vec<Function>,
    /// What inputs cannot be.
    pub restrictions: Vec<Restriction>,
    /// The signals with a definition, each behind those it uses.
    pub order: Vec<SignalId>,
}

/// A group of functions, with a name and, perhaps, words for people.
#[derive(Clone, Debug)]
pub struct Zone {
    /// Its name.
    pub name: String,
    /// What it is called.
    pub title: Option<String>,
}

/// A safety instrumented function, in the three sections of the seed paper's template.
#[derive(Clone, Debug)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// What it is called.
    pub title: Option<String>,
    /// Its zone: the position among the zones.
    pub zone: Option<usize>,
    /// Section 1: what is said of it for people, as pairs of a word and a text: `sil`, `3`.
    pub informal: Vec<(String, String)>,
    /// Section 2: the inputs it lists; some may be outputs of other functions.
    pub inputs: Vec<SignalId>,
    /// Section 2: its outputs.
    pub outputs: Vec<SignalId>,
    /// Section 3: what it defines, outputs and auxiliary values, in the order in which they are written.
    pub equations: Vec<SignalId>,
    /// Where it stands.
    pub place: Place,
}

/// A value that is TRUE or FALSE.
#[derive(Clone, Debug)]
pub struct Signal {
    /// Its name as it was written first; auxiliary values begin with the name of their function: `F1.Trigger`.
    pub name: String,
    /// What it is, for people.
    pub description: Option<String>,
    /// What it is in the program.
    pub binding: Option<Binding>,
    /// Where its value comes from.
    pub kind: Kind,
    /// Where it is declared, or defined if it is not declared.
    pub place: Place,
}

/// Where the value of a signal comes from.
#[derive(Clone, Debug)]
pub enum Kind {
    /// From outside. At rest it has this value.
    Input {
        /// What it has where nothing is asked of it.
        rest: bool,
    },
    /// A function computes it.
    Defined {
        /// The position of that function.
        function: usize,
        /// What it is.
        formula: Formula,
        /// Whether it goes out, or is only an auxiliary value.
        is_output: bool,
        /// It is remembered until this is true and the formula false.
        latched: Option<Formula>,
        /// It comes so many milliseconds after the formula has become true.
        delayed: Option<u32>,
        /// Where the equation stands.
        place: Place,
    },
}

/// What a signal is called in the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Binding {
    /// A variable of this name: `is Valve`.
    Variable(String, Place),
    /// What is located there: `at %IX0.0`.
    Address(String, Place),
}

/// Something that inputs cannot be.
#[derive(Clone, Debug)]
pub struct Restriction {
    /// Its name.
    pub name: String,
    /// What it says in the words of its author.
    pub sentence: Option<String>,
    /// Whose valuations it restricts.
    pub scope: Scope,
    /// What is true of every valuation that can be.
    pub allowed: Formula,
    /// As it was written, on one line, without its name.
    pub text: String,
    /// Where it stands.
    pub place: Place,
}

/// Whose valuations a restriction restricts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Those of all functions.
    System,
    /// Those of the functions of a zone.
    Zone(usize),
    /// Those of one function.
    Function(usize),
}

/// Where something stands: the position of its file, and the bytes there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The position of the file among those that were read.
    pub file: usize,
    /// The bytes.
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

    /// What a signal is defined as; nothing if it is an input.
    #[must_use]
    pub fn definition(&self, id: SignalId) -> Option<&Formula> {
        match &self.signals[id.0].kind {
            Kind::Input { .. } => None,
            Kind::Defined { formula, .. } => Some(formula),
        }
    }

    /// What a signal is computed from, and reset by, in the order in which the formulas name it; nothing for an input.
    #[must_use]
    pub fn uses(&self, id: SignalId) -> Vec<SignalId> {
        match &self.signals[id.0].kind {
            Kind::Input { .. } => Vec::new(),
            Kind::Defined { formula, latched, .. } => {
                formula.signals().into_iter().chain(latched.iter().flat_map(Formula::signals)).collect()
            }
        }
    }

    /// A formula as it is written.
    #[must_use]
    pub fn text(&self, formula: &Formula) -> String {
        formula.text(&|signal| self.name(signal))
    }

    /// The inputs, in the order in which they were declared.
    pub fn inputs(&self) -> impl Iterator<Item = SignalId> {
        let is_input = |id: &SignalId| matches!(self.signals[id.0].kind, Kind::Input { .. });
        (0..self.signals.len()).map(SignalId).filter(is_input)
    }

    /// The outputs of all functions, in the order of the functions.
    pub fn outputs(&self) -> impl Iterator<Item = SignalId> {
        self.functions.iter().flat_map(|function| function.outputs.iter().copied())
    }

    /// The value an input has at rest; FALSE for anything else.
    #[must_use]
    pub fn rest(&self, id: SignalId) -> bool {
        matches!(self.signals[id.0].kind, Kind::Input { rest: true })
    }

    /// The restrictions of a function's valuations: its own, its zone's, and the system's.
    pub fn restrictions_of(&self, function: usize) -> impl Iterator<Item = &Restriction> {
        let zone = self.functions[function].zone;
        self.restrictions.iter().filter(move |restriction| match restriction.scope {
            Scope::System => true,
            Scope::Zone(of) => Some(of) == zone,
            Scope::Function(of) => of == function,
        })
    }

    /// The set of these signals. All sets of signals that are passed around are as long as there are signals.
    #[must_use]
    pub fn valuation(&self, ones: impl IntoIterator<Item = SignalId>) -> FixedBitSet {
        let mut set = FixedBitSet::with_capacity(self.signals.len());
        ones.into_iter().for_each(|signal| set.insert(signal.0));
        set
    }

    /// Computes what is defined from the inputs, on 64 valuations at once: one word per signal.
    pub fn settle(&self, words: &mut [u64]) {
        for &id in &self.order {
            if let Some(formula) = self.definition(id) {
                words[id.0] = formula.evaluate(&|signal| words[signal.0]);
            }
        }
    }

    /// The same for any number of valuations: each set gets what is defined, too.
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

    /// All signals that are TRUE where the inputs in this set are. What is latched or delayed has the value of its formula.
    #[must_use]
    pub fn settled(&self, inputs: &FixedBitSet) -> FixedBitSet {
        let mut words: Vec<u64> = (0..self.signals.len()).map(|id| u64::from(inputs.contains(id))).collect();
        self.settle(&mut words);
        self.valuation((0..words.len()).filter(|id| words[*id] & 1 == 1).map(SignalId))
    }
}
