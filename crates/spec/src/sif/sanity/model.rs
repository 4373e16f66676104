//! A cone in a solver: signals as literals, variants with a change, and cores of restrictions.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use fixedbitset::FixedBitSet;

use super::super::cone::{Cone, inputs_of};
use super::super::formula::{Formula, SignalId};
use super::super::solver::{Answer, Literal, Solver, Stop};
use super::super::specification::{Kind, Specification};
use super::finding::Example;

/// Upper bound on decisions of the solver per question; the result is the same on every machine.
const DECISIONS: u64 = 300_000;

/// A cone encoded in a solver.
pub struct Model<'s> {
    pub specification: &'s Specification,
    pub cone: Cone<'s>,
    pub solver: Solver,
    /// Signals without change.
    pub values: Values,
    /// Restrictions of the cone: position in the specification, and literal.
    pub restrictions: Vec<(usize, Literal)>,
    /// For latched or delayed signals, whether the signal was TRUE in the scan before, and whether its formula has been
    /// for long enough.
    memory: Vec<Option<(Literal, Literal)>>,
    left: Arc<AtomicU64>,
    stop: Stop,
}

/// Literals of the specification's signals; meaningless outside the cone.
#[derive(Clone)]
pub struct Values {
    /// Value used by other formulas.
    seen: Vec<Literal>,
    /// Value of the formula.
    pub formula: Vec<Literal>,
    /// Value of the reset condition.
    pub reset: Vec<Literal>,
}

/// Change of a specification.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// The value of an input is inverted.
    Input(SignalId),
    /// An occurrence of a signal is negated.
    Occurrence(Occurrence),
}

/// Occurrence of a signal in a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Occurrence {
    /// Signal defined by the formula.
    pub of: SignalId,
    /// Whether the occurrence is in the reset condition.
    pub in_reset: bool,
    /// Number of occurrences to its left.
    pub at: usize,
}

impl<'s> Model<'s> {
    /// Encodes a cone; restrictions become literals and are not asserted.
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

    /// Whether the caller wants the work to end.
    pub fn is_stopped(&self) -> bool {
        (self.stop)()
    }

    /// Values of the signals after a change.
    pub fn changed(&mut self, change: Change) -> Values {
        self.computed(Some(change))
    }

    /// Literal of a formula.
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
        // Reset conditions may use later definitions.
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
        // Signals are renumbered by occurrence.
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

    /// Searches for a model of these literals.
    pub fn ask(&mut self, wanted: &[Literal]) -> Answer {
        self.left.store(DECISIONS, Ordering::Relaxed);
        self.solver.solve(wanted)
    }

    /// As [`Model::ask`], under some restrictions.
    pub fn ask_keeping(&mut self, wanted: &[Literal], kept: &[(usize, Literal)]) -> Answer {
        let all: Vec<Literal> = wanted.iter().copied().chain(kept.iter().map(|kept| kept.1)).collect();
        self.ask(&all)
    }

    /// As [`Model::ask`], under all restrictions of the cone.
    pub fn ask_allowed(&mut self, wanted: &[Literal]) -> Answer {
        let kept = self.restrictions.clone();
        self.ask_keeping(wanted, &kept)
    }

    /// Minimal core of restrictions that exclude the literals, after the answer "unsatisfiable"; not minimal if the
    /// solver is stopped.
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

    /// Minimal core of all restrictions, and an example: a valuation with the literals, if only restrictions exclude
    /// them, violating as few as possible; else an allowed one.
    pub fn explained(&mut self, wanted: &[Literal], about: &[SignalId]) -> (Vec<usize>, Option<Example>) {
        let kept = self.restrictions.clone();
        let core = self.blame(wanted, &kept);
        (core.clone(), self.example(wanted, &core, &kept, about))
    }

    /// Example for a core.
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

    /// Value of an input in the model found last.
    pub fn is_true(&self, input: SignalId) -> bool {
        self.solver.value(self.values.seen[input.0])
    }

    /// The model found last: these inputs, those of these restrictions, and the latched or delayed signals used.
    pub fn told(&self, about: &[SignalId], core: &[usize], is_excluded: bool) -> Example {
        let of = |at: &usize| inputs_of(self.specification, &self.specification.restrictions[*at].allowed);
        let mut signals = about.to_vec();
        for signal in core.iter().flat_map(of) {
            if !signals.contains(&signal) {
                signals.push(signal);
            }
        }
        // A latched or delayed signal matters where a formula uses it.
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

/// Position of the negated occurrence in a formula, if any.
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
