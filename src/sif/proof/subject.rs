//! What is claimed of a program, and what the claims are about: signals, and the variables they stand for.

use fixedbitset::FixedBitSet;

use crate::sif::{Binder, Formula, Kind, Located, Scope, SignalId, Specification};
use petril_base::diagnostic::{Code, Diagnostic};
use petril_lang::flat::{FlatProgram, Tolerated};
use petril_lang::semantics::VarId;

/// A specification, a program, and what is claimed of both.
#[derive(Clone, Debug)]
pub struct Subject<'a> {
    /// What is to be computed.
    pub specification: &'a Specification,
    /// What computes it.
    pub program: &'a FlatProgram,
    /// The hazards that are no errors.
    pub tolerated: Tolerated,
    /// The variable that each signal stands for, of those that matter.
    pub variables: Vec<Option<VarId>>,
    /// What is claimed: one for each output.
    pub claims: Vec<Claim>,
    /// The definitions that matter, each behind those it uses.
    pub definitions: Vec<SignalId>,
    /// Inputs that only restrictions speak of, and that the program does not have.
    pub outside: Vec<SignalId>,
    /// The positions of the restrictions that matter to some claim.
    pub restrictions: Vec<usize>,
    /// Of these, the ones that all scans keep, whatever function is meant.
    pub everywhere: Vec<usize>,
}

/// What is claimed of an output, at the end of every scan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// The output.
    pub signal: SignalId,
    /// The variable it stands for.
    pub variable: VarId,
    /// How it has to go with what is specified.
    pub form: Form,
    /// The positions of the restrictions that all scans keep.
    pub restrictions: Vec<usize>,
}

/// How an output has to go with what is specified.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// It is the formula, over the inputs of the same scan.
    Equal,
    /// It is TRUE if the formula is, or if it was at the end of the scan before and what resets it is not.
    Latched,
    /// It is TRUE only where the same without delay is. When it comes is not claimed.
    NotWithout,
}

impl Form {
    /// Whether an output may be so where this is wanted.
    #[must_use]
    pub fn fits(self, is: bool, wanted: bool) -> bool {
        match self {
            Self::Equal | Self::Latched => is == wanted,
            Self::NotWithout => !is || wanted,
        }
    }
}

impl<'a> Subject<'a> {
    /// What is claimed of a program by these functions, or by all if none are named.
    ///
    /// # Errors
    /// Signals that stand for nothing in the program, or for what they cannot.
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
            // What no formula of the functions needs may be the business of another program.
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

    /// Whether a signal is remembered from scan to scan.
    #[must_use]
    pub fn latch(&self, signal: SignalId) -> Option<&'a Formula> {
        match &self.specification.signals[signal.0].kind {
            Kind::Defined { latched, .. } => latched.as_ref(),
            Kind::Input { .. } => None,
        }
    }

    /// Whether a signal comes later than its formula says, so that others see what the program makes of it.
    #[must_use]
    pub fn is_delayed(&self, signal: SignalId) -> bool {
        matches!(self.specification.signals[signal.0].kind, Kind::Defined { delayed: Some(_), .. })
    }

    /// The inputs that a signal is computed from, also to be reset, in their order.
    #[must_use]
    pub fn inputs_of(&self, signal: SignalId) -> Vec<SignalId> {
        let mut inside = Inside::new(self.specification);
        inside.add(signal);
        let inputs = inside.seen.ones().map(SignalId);
        inputs.filter(|id| matches!(self.specification.signals[id.0].kind, Kind::Input { .. })).collect()
    }

    /// The input signals that stand for variables of the program.
    pub fn inputs(&self) -> impl Iterator<Item = (SignalId, VarId)> {
        let bound = self.variables.iter().enumerate();
        bound
            .filter_map(|(id, variable)| variable.map(|variable| (SignalId(id), variable)))
            .filter(|(id, _)| matches!(self.specification.signals[id.0].kind, Kind::Input { .. }))
    }
}

/// Signals, with all they are computed from, resets too.
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

/// Those of the definitions that are needed, each behind those it uses, also to be reset; or one that is reset by way of itself.
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
