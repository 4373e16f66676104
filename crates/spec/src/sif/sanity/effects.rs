//! Inputs that are mentioned but have no effect.

use fixedbitset::FixedBitSet;

use super::super::formula::SignalId;
use super::super::solver::{Answer, Literal};
use super::super::specification::Specification;
use super::finding::{Doubt, Example, Finding};
use super::model::{Change, Model, Values};

/// Effect of each input, as known after the functions seen so far.
pub struct Effects<'s> {
    specification: &'s Specification,
    /// Inputs with an effect, or that nothing is to be reported about.
    settled: FixedBitSet,
    /// Inputs for which the question is open in some function.
    open: FixedBitSet,
    /// For each input without effect, the restrictions responsible, and an example.
    because: Vec<(Vec<usize>, Option<Example>)>,
}

impl<'s> Effects<'s> {
    /// Starts without knowledge.
    pub fn new(specification: &'s Specification) -> Self {
        let (settled, open) = (specification.valuation([]), specification.valuation([]));
        Self { specification, settled, open, because: vec![(Vec::new(), None); specification.signals.len()] }
    }

    /// Suppresses reports about the inputs of a function without allowed valuations.
    pub fn leave_open(&mut self, model: &Model<'_>) {
        model.cone.inputs.iter().for_each(|input| self.settled.insert(input.0));
    }

    /// Examines a function. If some of its outputs are constant, its inputs are not reported in addition.
    pub fn see(&mut self, model: &mut Model<'_>, function: usize, constant: &[SignalId]) {
        if !constant.is_empty() {
            self.leave_open(model);
            return;
        }
        let roots = roots(self.specification, function, constant);
        for input in model.cone.inputs.clone() {
            if self.settled.contains(input.0) {
                continue;
            }
            let changed = model.changed(Change::Input(input));
            let differs = differs(model, &changed, &roots);
            match model.ask_allowed(&[differs]) {
                Answer::Satisfiable => self.settled.insert(input.0),
                Answer::Stopped => self.open.insert(input.0),
                Answer::Unsatisfiable => {
                    let about = model.cone.inputs.clone();
                    let (core, example) = model.explained(&[differs], &about);
                    let (known, shown) = &mut self.because[input.0];
                    known.extend(core);
                    known.sort_unstable();
                    known.dedup();
                    let is_better = |old: &Example, new: &Example| new.is_excluded && !old.is_excluded;
                    if let Some(new) = example
                        && shown.as_ref().is_none_or(|old| is_better(old, &new))
                    {
                        *shown = Some(new);
                    }
                }
            }
        }
    }

    /// Inputs without effect on any function, except those not used at all.
    pub fn findings(&self, unused: &FixedBitSet) -> Vec<Finding> {
        let mut findings = Vec::new();
        for input in self.specification.inputs().filter(|id| !unused.contains(id.0) && !self.settled.contains(id.0)) {
            let place = self.specification.signal(input).place;
            if self.open.contains(input.0) {
                let question = format!("the input `{}` makes a difference", self.specification.name(input));
                findings.push(Finding::open(place, question));
                continue;
            }
            let (core, example) = self.because[input.0].clone();
            findings.push(Finding::new(Doubt::InputWithoutEffect, place).signals([input]).because(core, example));
        }
        findings
    }
}

/// Observation points: the outputs of a function, except some.
pub fn roots(specification: &Specification, function: usize, but: &[SignalId]) -> Vec<SignalId> {
    let outputs = specification.functions[function].outputs.iter().copied();
    outputs.filter(|output| !but.contains(output)).collect()
}

/// Literal that is true when the formula or the reset condition of some root has changed.
pub fn differs(model: &mut Model<'_>, changed: &Values, roots: &[SignalId]) -> Literal {
    let mut any = Vec::new();
    for root in roots {
        any.push(model.solver.xor(model.values.formula[root.0], changed.formula[root.0]));
        any.push(model.solver.xor(model.values.reset[root.0], changed.reset[root.0]));
    }
    model.solver.or(any)
}
