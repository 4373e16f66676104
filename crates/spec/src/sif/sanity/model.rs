//! A cone in a solver: its signals as literals, also with something changed, and which restrictions are to blame.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use fixedbitset::FixedBitSet;

use super::super::cone::{Cone, inputs_of};
use super::super::formula::{Formula, SignalId};
use super::super::solver::{Answer, Literal, Solver, Stop};
use super::super::specification::{Kind, Specification};
use super::finding::Example;

/// How many decisions the solver may make for one question. The same on every machine.
const DECISIONS: u64 = 300_000;

/// A cone in a solver.
pub struct Model<'s> {
    pub specification: &'s Specification,
    pub cone: Cone<'s>,
    pub solver: Solver,
    /// The signals as they are.
    pub values: Values,
    /// The restrictions of the cone: their positions in the specification, and what they allow.
    pub restrictions: Vec<(usize, Literal)>,
    /// What was TRUE in the scan before, and what has been for long enough.
    memory: Vec<Option<(Literal, Literal)>>,
    left: Arc<AtomicU64>,
    stop: Stop,
}

/// Literals for the signals of the specification; those outside of the cone mean nothing.
#[derive(Clone)]
pub struct Values {
    /// What those who use a signal see.
    seen: Vec<Literal>,
    /// What its formula says.
    pub formula: Vec<Literal>,
    /// What its reset says.
    pub reset: Vec<Literal>,
}

/// What is not as it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// An input has the opposite value.
    Input(SignalId),
    /// One occurrence of a signal is negated.
    Occurrence(Occurrence),
}

/// Where a formula names a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Occurrence {
    /// What is defined.
    pub of: SignalId,
    /// Whether this is in its reset, not in its formula.
    pub in_reset: bool,
    /// How many others stand to the left.
    pub at: usize,
}

impl<'s> Model<'s> {
    /// The cone, its restrictions only as literals.
    pub fn new(specification: &'s Specification, cone: Cone<'s>, outside: &Stop) -> Self {
        let left = Arc::new(AtomicU64::new(DECISIONS));
        let (budget, outer) = (Arc::clone(&left), Arc::clone(outside));
        let take = |left: u64| left.checked_sub(1);
        let stop: Stop =
            Arc::new(move || budget.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take).is_err() || outer());
        let mut solver = Solver::new(&stop);
        let nothing = vec![solver.constant(false); specification.signals.len()];
        let mut seen = nothing.clone();
        cone.all_inputs().for_each(|input| seen[input.0] = solver.fresh());
        let mut memory = vec![None; specification.signals.len()];
        for &id in &cone.definitions {
            if let Kind::Defined { latched, delayed, .. } = &specification.signal(id).kind
                && (latched.is_some() || delayed.is_some())
            {
                memory[id.0] = Some((solver.fresh(), solver.fresh()));
            }
        }
        let values = Values { seen, formula: nothing.clone(), reset: nothing };
        let mut model = Self {
            specification,
            cone,
            solver,
            values,
            restrictions: Vec::new(),
            memory,
            left,
            stop: Arc::clone(outside),
        };
        model.values = model.computed(None);
        let mut kept = model.cone.restrictions.iter().peekable();
        for (at, restriction) in specification.restrictions.iter().enumerate() {
            if kept.next_if(|kept| std::ptr::eq(**kept, restriction)).is_some() {
                let seen = &model.values.seen;
                let literal = model.solver.formula(&restriction.allowed, &|signal| seen[signal.0]);
                model.restrictions.push((at, literal));
            }
        }
        model
    }

    /// Whether whoever asks wants the work to end.
    pub fn is_stopped(&self) -> bool {
        (self.stop)()
    }

    /// The signals with something changed.
    pub fn changed(&mut self, change: Change) -> Values {
        self.computed(Some(change))
    }

    /// What a formula says.
    pub fn literal(&mut self, formula: &Formula) -> Literal {
        let seen = &self.values.seen;
        self.solver.formula(formula, &|signal| seen[signal.0])
    }

    fn computed(&mut self, change: Option<Change>) -> Values {
        let mut values = self.values.clone();
        let mut dirty = FixedBitSet::with_capacity(values.seen.len());
        if let Some(Change::Input(input)) = change {
            values.seen[input.0] = !values.seen[input.0];
            dirty.insert(input.0);
        }
        let mut kept = Vec::new();
        for id in self.cone.definitions.clone() {
            let Kind::Defined { formula, latched, delayed, .. } = &self.specification.signal(id).kind else { continue };
            let flipped = flipped(change, id, false);
            let is_touched = change.is_none() || flipped.is_some() || names(formula, &dirty);
            if is_touched {
                values.formula[id.0] = self.written(formula, &values.seen, flipped);
            }
            let mut seen = values.formula[id.0];
            if let Some((_, is_long)) = self.memory[id.0] {
                if delayed.is_some() {
                    seen = self.solver.and([seen, is_long]);
                }
                if latched.is_some() {
                    let keeps = self.solver.fresh();
                    seen = self.solver.or([seen, keeps]);
                    kept.push((id, keeps));
                }
            }
            if seen != values.seen[id.0] {
                dirty.insert(id.0);
            }
            values.seen[id.0] = seen;
        }
        // Resets may name what is defined behind them.
        for (id, keeps) in kept {
            let Kind::Defined { latched: Some(reset), .. } = &self.specification.signal(id).kind else { continue };
            let flipped = flipped(change, id, true);
            if change.is_none() || flipped.is_some() || names(reset, &dirty) {
                values.reset[id.0] = self.written(reset, &values.seen, flipped);
            }
            let Some((was, _)) = self.memory[id.0] else { continue };
            let both = self.solver.and([was, !values.reset[id.0]]);
            self.solver.require([!keeps, both]);
            self.solver.require([keeps, !both]);
        }
        values
    }

    fn written(&mut self, formula: &Formula, seen: &[Literal], flipped: Option<usize>) -> Literal {
        let Some(flipped) = flipped else { return self.solver.formula(formula, &|signal| seen[signal.0]) };
        // Signals become the numbers of their occurrences.
        let mut signals = Vec::new();
        let numbered = formula.map(&mut |signal| {
            signals.push(*signal);
            SignalId(signals.len() - 1)
        });
        self.solver.formula(&numbered, &|SignalId(at)| {
            let literal = seen[signals[at].0];
            if at == flipped { !literal } else { literal }
        })
    }

    /// Looks for a model of all this.
    pub fn ask(&mut self, wanted: &[Literal]) -> Answer {
        self.left.store(DECISIONS, Ordering::Relaxed);
        self.solver.solve(wanted)
    }

    /// The same where restrictions are kept: all of the cone, or some.
    pub fn ask_keeping(&mut self, wanted: &[Literal], kept: &[(usize, Literal)]) -> Answer {
        let all: Vec<Literal> = wanted.iter().copied().chain(kept.iter().map(|kept| kept.1)).collect();
        self.ask(&all)
    }

    /// Whether this can be where all restrictions are kept.
    pub fn ask_allowed(&mut self, wanted: &[Literal]) -> Answer {
        let kept = self.restrictions.clone();
        self.ask_keeping(wanted, &kept)
    }

    /// The restrictions because of which this cannot be, after it could not: none of them can be left out, unless the solver
    /// was stopped.
    pub fn blame(&mut self, wanted: &[Literal], kept: &[(usize, Literal)]) -> Vec<usize> {
        let all: Vec<Literal> = wanted.iter().copied().chain(kept.iter().map(|kept| kept.1)).collect();
        let core = self.solver.core(&all);
        let mut left: Vec<(usize, Literal)> = kept.iter().copied().filter(|kept| core.contains(&kept.1)).collect();
        if self.ask_keeping(wanted, &left) != Answer::Unsatisfiable {
            left = kept.to_vec();
        }
        for candidate in left.clone().into_iter().rev() {
            let without: Vec<_> = left.iter().copied().filter(|other| other.0 != candidate.0).collect();
            if self.ask_keeping(wanted, &without) == Answer::Unsatisfiable {
                left = without;
            }
        }
        left.into_iter().map(|(at, _)| at).collect()
    }

    /// The core of all restrictions, and an example: where something wanted is only excluded by them, a valuation in which it
    /// is, excluded by as few as can be; else any that is allowed.
    pub fn explained(&mut self, wanted: &[Literal], about: &[SignalId]) -> (Vec<usize>, Option<Example>) {
        let kept = self.restrictions.clone();
        let core = self.blame(wanted, &kept);
        (core.clone(), self.example(wanted, &core, &kept, about))
    }

    /// The example for a core.
    pub fn example(
        &mut self,
        wanted: &[Literal],
        core: &[usize],
        kept: &[(usize, Literal)],
        about: &[SignalId],
    ) -> Option<Example> {
        let Some(last) = core.last() else {
            return (self.ask_keeping(&[], kept) == Answer::Satisfiable).then(|| self.told(about, core, false));
        };
        let others: Vec<_> = kept.iter().copied().filter(|other| other.0 != *last).collect();
        let is_found = self.ask_keeping(wanted, &others) == Answer::Satisfiable || {
            let outside: Vec<_> = kept.iter().copied().filter(|other| !core.contains(&other.0)).collect();
            self.ask_keeping(wanted, &outside) == Answer::Satisfiable
        };
        let is_found = is_found || self.ask(wanted) == Answer::Satisfiable;
        is_found.then(|| self.told(about, core, true))
    }

    /// What an input is in the model that was found last.
    pub fn is_true(&self, input: SignalId) -> bool {
        self.solver.value(self.values.seen[input.0])
    }

    /// The model that was found last: these inputs, those of these restrictions, and what is remembered.
    pub fn told(&self, about: &[SignalId], core: &[usize], is_excluded: bool) -> Example {
        let of = |at: &usize| inputs_of(self.specification, &self.specification.restrictions[*at].allowed);
        let mut signals = about.to_vec();
        for signal in core.iter().flat_map(of) {
            if !signals.contains(&signal) {
                signals.push(signal);
            }
        }
        // What is remembered counts where a formula uses it.
        let mut used = FixedBitSet::with_capacity(self.memory.len());
        for id in &self.cone.definitions {
            if let Kind::Defined { formula, latched, .. } = &self.specification.signal(*id).kind {
                std::iter::once(formula)
                    .chain(latched)
                    .for_each(|f| f.each_signal(&mut |signal| used.insert(signal.0)));
            }
        }
        let restrictions = core.iter().map(|at| &self.specification.restrictions[*at].allowed);
        restrictions.for_each(|f| f.each_signal(&mut |signal| used.insert(signal.0)));
        let is_used = |id: &SignalId| self.memory[id.0].is_some() && used.contains(id.0);
        signals.extend(self.cone.definitions.iter().copied().filter(is_used));
        let value = |signal: SignalId| (signal, self.solver.value(self.values.seen[signal.0]));
        Example { values: signals.into_iter().map(value).collect(), is_excluded }
    }
}

/// Which occurrence in a formula is negated.
fn flipped(change: Option<Change>, of: SignalId, in_reset: bool) -> Option<usize> {
    match change {
        Some(Change::Occurrence(occurrence)) if occurrence.of == of && occurrence.in_reset == in_reset => {
            Some(occurrence.at)
        }
        _ => None,
    }
}

fn names(formula: &Formula, signals: &FixedBitSet) -> bool {
    let mut found = false;
    formula.each_signal(&mut |signal| found |= signals.contains(signal.0));
    found
}
