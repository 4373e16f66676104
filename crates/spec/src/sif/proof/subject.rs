//! Claims about a program, and the signals they are about with their variables.

use fixedbitset::FixedBitSet;

use crate::sif::{Binder, Formula, Kind, Located, Scope, SignalId, Specification};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_lang::flat::{FlatProgram, Tolerated};
use petril_lang::semantics::VarId;

/// Specification and program with the claims that relate them.
#[derive(Clone, Debug)]
pub struct Subject<'a> {
    /// Specification.
    pub specification: &'a Specification,
    /// Program.
    pub program: &'a FlatProgram,
    /// Hazards that are not errors.
    pub tolerated: Tolerated,
    /// Variable of each relevant signal.
    pub variables: Vec<Option<VarId>>,
    /// Claims, one for each output.
    pub claims: Vec<Claim>,
    /// Relevant definitions, in topological order: each after those it uses.
    pub definitions: Vec<SignalId>,
    /// Inputs mentioned by restrictions only that the program does not have.
    pub outside: Vec<SignalId>,
    /// Positions of the restrictions that are relevant to some claim.
    pub restrictions: Vec<usize>,
    /// Positions of those that apply to every function.
    pub everywhere: Vec<usize>,
}

/// Claim about an output, at the end of every scan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// Output.
    pub signal: SignalId,
    /// Variable of the output.
    pub variable: VarId,
    /// Required relation to the specified value.
    pub form: Form,
    /// Positions of the restrictions that all scans satisfy.
    pub restrictions: Vec<usize>,
}

/// Required relation of an output to its specified value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Equality with the formula, over the inputs of the same scan.
    Equal,
    /// Latch: TRUE if the formula is, or if it was TRUE at the end of the previous scan and the reset condition is
    /// false.
    Latched,
    /// Upper bound only, for a delayed output: TRUE only where the output without delay is. The delay itself is not
    /// claimed.
    NotWithout,
}

impl Form {
    /// Whether an output value satisfies the relation to the specified value.
    #[must_use]
    pub fn fits(self, is: bool, wanted: bool) -> bool {
        match self {
            Self::Equal | Self::Latched => is == wanted,
            Self::NotWithout => !is || wanted,
        }
    }
}

impl<'a> Subject<'a> {
    /// Collects the claims of these functions about a program, or of all if none are named.
    ///
    /// # Errors
    /// Signals whose variable is missing or unsuitable.
    pub fn new(
        specification: &'a Specification,
        program: &'a FlatProgram,
        tolerated: Tolerated,
        functions: &[usize],
    ) -> Result<Self, Vec<Located>> {
        let named = |function: &usize| functions.is_empty() || functions.contains(function);
        let functions: Vec<usize> = (0..specification.functions.len()).filter(named).collect();
        let applies = |function: usize, scope: Scope| match scope {
            Scope::System => true,
            Scope::Zone(zone) => specification.functions[function].zone == Some(zone),
            Scope::Function(own) => own == function,
        };
        let restrictions = |applies: &dyn Fn(Scope) -> bool| -> Vec<usize> {
            (0..specification.restrictions.len()).filter(|&at| applies(specification.restrictions[at].scope)).collect()
        };
        let mut wanted = Vec::new();
        let (mut computed, mut restricted) = (Inside::new(specification), Inside::new(specification));
        let everywhere = restrictions(&|scope| scope == Scope::System);
        everywhere.iter().for_each(|&at| restricted.add_all(&specification.restrictions[at].allowed));
        for &function in &functions {
            let own = restrictions(&|scope| applies(function, scope));
            own.iter().for_each(|&at| restricted.add_all(&specification.restrictions[at].allowed));
            for &output in &specification.functions[function].outputs {
                computed.add(output);
                wanted.push((output, own.clone()));
            }
        }
        let mut binder = Binder::new(specification, program);
        let mut outside = Vec::new();
        for id in (0..specification.signals.len()).map(SignalId) {
            let signal = specification.signal(id);
            let is_claimed = wanted.iter().any(|(output, _)| *output == id);
            let has_variable = match signal.kind {
                Kind::Input { .. } => computed.seen.contains(id.0) || restricted.seen.contains(id.0),
                Kind::Defined { delayed, .. } => {
                    is_claimed || delayed.is_some() && (computed.seen.contains(id.0) || restricted.seen.contains(id.0))
                }
            };
            if !has_variable {
                continue;
            }
            // An input that no formula of the functions needs may belong to another program.
            let may_miss = !computed.seen.contains(id.0) && signal.binding.is_none();
            if may_miss && matches!(signal.kind, Kind::Input { .. }) && program.find(&signal.name).is_none() {
                outside.push(id);
            } else {
                binder.bind(id);
            }
        }
        let variables = binder.finish()?;
        let claims = wanted.into_iter().filter_map(|(signal, restrictions)| {
            let form = match specification.signal(signal).kind {
                Kind::Defined { delayed: Some(_), .. } => Form::NotWithout,
                Kind::Defined { latched: Some(_), .. } => Form::Latched,
                _ => Form::Equal,
            };
            Some(Claim { signal, variable: variables[signal.0]?, form, restrictions })
        });
        let claims: Vec<Claim> = claims.collect();
        let mut used: Vec<usize> = claims.iter().flat_map(|claim| claim.restrictions.iter().copied()).collect();
        used.extend(&everywhere);
        used.sort_unstable();
        used.dedup();
        let mut needed = computed.seen;
        needed.union_with(&restricted.seen);
        let definitions = in_order(specification, &needed).map_err(|id| {
            let signal = specification.signal(id);
            let message = format!("whether `{}` is reset depends on what it is", signal.name);
            let help = "let what resets it depend on inputs and on other outputs";
            vec![(signal.place.file, Diagnostic::new(Code::SifCycle, signal.place.span, message).help(help))]
        })?;
        Ok(Self {
            specification,
            program,
            tolerated,
            variables,
            claims,
            definitions,
            outside,
            restrictions: used,
            everywhere,
        })
    }

    /// Reset condition of a latched signal.
    #[must_use]
    pub fn latch(&self, signal: SignalId) -> Option<&'a Formula> {
        match &self.specification.signals[signal.0].kind {
            Kind::Defined { latched, .. } => latched.as_ref(),
            Kind::Input { .. } => None,
        }
    }

    /// Whether a signal is delayed, so that other definitions use the program's value of it.
    #[must_use]
    pub fn is_delayed(&self, signal: SignalId) -> bool {
        matches!(self.specification.signals[signal.0].kind, Kind::Defined { delayed: Some(_), .. })
    }

    /// Inputs that a signal or its reset condition is computed from, in their order.
    #[must_use]
    pub fn inputs_of(&self, signal: SignalId) -> Vec<SignalId> {
        let mut inside = Inside::new(self.specification);
        inside.add(signal);
        let inputs = inside.seen.ones().map(SignalId);
        inputs.filter(|id| matches!(self.specification.signals[id.0].kind, Kind::Input { .. })).collect()
    }

    /// Input signals with their variables in the program.
    pub fn inputs(&self) -> impl Iterator<Item = (SignalId, VarId)> {
        let bound = self.variables.iter().enumerate();
        bound
            .filter_map(|(id, variable)| variable.map(|variable| (SignalId(id), variable)))
            .filter(|(id, _)| matches!(self.specification.signals[id.0].kind, Kind::Input { .. }))
    }
}

/// Signals with everything they are computed from, reset conditions included.
struct Inside<'a> {
    specification: &'a Specification,
    seen: FixedBitSet,
}

impl<'a> Inside<'a> {
    fn new(specification: &'a Specification) -> Self {
        Self { specification, seen: FixedBitSet::with_capacity(specification.signals.len()) }
    }

    fn add_all(&mut self, formula: &Formula) {
        formula.signals().into_iter().for_each(|signal| self.add(signal));
    }

    fn add(&mut self, signal: SignalId) {
        let mut left = vec![signal];
        while let Some(signal) = left.pop() {
            if !self.seen.put(signal.0) {
                left.extend(self.specification.uses(signal));
            }
        }
    }
}

/// Needed definitions in topological order, reset conditions included; or a definition whose reset depends on itself.
fn in_order(specification: &Specification, needed: &FixedBitSet) -> Result<Vec<SignalId>, SignalId> {
    let mut left: Vec<SignalId> = specification.order.iter().copied().filter(|id| needed.contains(id.0)).collect();
    let mut waiting = FixedBitSet::with_capacity(specification.signals.len());
    left.iter().for_each(|id| waiting.insert(id.0));
    let mut order = Vec::with_capacity(left.len());
    loop {
        let before = order.len();
        left.retain(|&id| {
            let waits = specification.uses(id).iter().any(|used| waiting.contains(used.0));
            if !waits {
                waiting.set(id.0, false);
                order.push(id);
            }
            waits
        });
        if order.len() == before {
            return left.first().map_or(Ok(order), |&first| Err(first));
        }
    }
}
