//! Unused inputs, and interfaces that do not match the formulas of their functions.

use fixedbitset::FixedBitSet;

use super::super::formula::{Formula, SignalId};
use super::super::specification::{Kind, Scope, Specification};
use super::finding::{Doubt, Finding};

/// Inputs that no equation and no reset condition mentions.
pub fn unused(specification: &Specification) -> FixedBitSet {
    let mut unused = specification.valuation(specification.inputs());
    for signal in &specification.signals {
        if let Kind::Defined { formula, latched, .. } = &signal.kind {
            each(formula, latched.as_ref(), &mut |signal| unused.set(signal.0, false));
        }
    }
    unused
}

/// Findings about unused inputs, and signals that functions list but do not use, or use but do not list.
pub fn interfaces(specification: &Specification, unused: &FixedBitSet) -> Vec<Finding> {
    let not_used = unused
        .ones()
        .map(SignalId)
        .map(|input| Finding::new(Doubt::InputNotUsed, specification.signal(input).place).signals([input]));
    let mut findings: Vec<Finding> = not_used.collect();
    for (at, function) in specification.functions.iter().enumerate() {
        let mut named = specification.valuation([]);
        let mut used: Vec<SignalId> = Vec::new();
        for &id in &function.equations {
            if let Kind::Defined { formula, latched, .. } = &specification.signal(id).kind {
                each(formula, latched.as_ref(), &mut |signal| {
                    if !named.put(signal.0) && !function.equations.contains(&signal) {
                        used.push(signal);
                    }
                });
            }
        }
        let own = specification.restrictions.iter().filter(|restriction| restriction.scope == Scope::Function(at));
        own.for_each(|restriction| restriction.allowed.each_signal(&mut |signal| named.insert(signal.0)));
        for &input in function.inputs.iter().filter(|input| !named.contains(input.0) && !unused.contains(input.0)) {
            findings.push(Finding::new(Doubt::InputListed, function.place).of(at).signals([input]));
        }
        // Interfaces without any input declare them elsewhere on purpose.
        used.retain(|signal| !function.inputs.contains(signal));
        if !used.is_empty() && !function.inputs.is_empty() {
            findings.push(Finding::new(Doubt::InputNotListed, function.place).of(at).signals(used));
        }
    }
    findings
}

fn each(formula: &Formula, reset: Option<&Formula>, see: &mut impl FnMut(SignalId)) {
    formula.each_signal(see);
    if let Some(reset) = reset {
        reset.each_signal(see);
    }
}
