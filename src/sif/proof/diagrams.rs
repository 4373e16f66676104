//! Decision diagrams as a second opinion on what holds from every state.

use fixedbitset::FixedBitSet;

use super::subject::{Claim, Form, Subject};
use crate::explore::{Gate, ScanGates, Wire};
use crate::sif::{Diagram, Diagrams, Kind, SignalId};

/// Nodes of a diagram, at most.
const MAX_NODES: usize = 1 << 14;

/// Nodes of all diagrams that are made for one claim, at most.
const MAX_WORK: usize = 1 << 21;

/// Whether a claim is never wrong, whatever scans begin with. Nothing if diagrams get too large.
pub(super) fn holds(subject: &Subject<'_>, gates: &ScanGates, claim: &Claim) -> Option<bool> {
    let mut opinion = Opinion::new(subject, gates, claim)?;
    let is = opinion.wire(gates.end[claim.variable.0][0])?;
    let signals = opinion.signals(claim)?;
    let wanted = signals.wanted;
    let mut bad = match claim.form {
        Form::Equal | Form::Latched => opinion.diagrams.xor(&is, &wanted)?,
        Form::NotWithout => opinion.diagrams.and(&is, &wanted.complement())?,
    };
    for &restriction in &claim.restrictions {
        if bad.is_empty() {
            return Some(true);
        }
        let allowed = &subject.specification.restrictions[restriction].allowed;
        let allowed = opinion.diagrams.formula(allowed, &|id| signals.values[id.0].clone())?;
        bad = opinion.diagrams.and(&bad, &allowed)?;
    }
    for (error, ..) in &gates.errors {
        if bad.is_empty() {
            return Some(true);
        }
        let error = opinion.wire(*error)?;
        bad = opinion.diagrams.and(&bad, &error.complement())?;
    }
    Some(bad.is_empty())
}

/// The diagrams of what a specification says.
struct Signals {
    /// Of those that matter.
    values: Vec<Option<Diagram>>,
    /// Of the claim's, without delay.
    wanted: Diagram,
}

struct Opinion<'a> {
    subject: &'a Subject<'a>,
    gates: &'a ScanGates,
    /// Over the inputs of the network, by their numbers; behind these, over what else is free, by signal.
    diagrams: Diagrams,
    nodes: Vec<Option<Diagram>>,
    work: usize,
}

impl<'a> Opinion<'a> {
    fn new(subject: &'a Subject<'a>, gates: &'a ScanGates, claim: &Claim) -> Option<Self> {
        // Inputs in the order in which the program and the specification come to them.
        let mut order = Vec::new();
        let mut seen = FixedBitSet::with_capacity(gates.first_gate() + gates.gates.len());
        let mut left: Vec<usize> = gates.errors.iter().map(|(wire, ..)| wire.node()).collect();
        left.extend(subject.inputs().map(|(_, variable)| gates.beginning[variable.0][0].node()));
        left.extend(
            subject
                .definitions
                .iter()
                .filter(|id| subject.is_delayed(**id))
                .filter_map(|id| subject.variables[id.0].map(|variable| gates.end[variable.0][0].node())),
        );
        left.push(gates.end[claim.variable.0][0].node());
        while let Some(node) = left.pop() {
            if node == 0 || seen.put(node) {
                continue;
            }
            match node.checked_sub(gates.first_gate()) {
                None => order.push(SignalId(node - 1)),
                Some(number) => {
                    let (Gate::And(a, b) | Gate::Xor(a, b)) = gates.gates[number];
                    left.extend([b.node(), a.node()]);
                }
            }
        }
        let free = subject.definitions.iter().filter(|id| subject.latch(**id).is_some()).chain(&subject.outside);
        order.extend(free.map(|id| SignalId(gates.inputs.len() + id.0)));
        let signals = gates.inputs.len() + subject.specification.signals.len();
        let diagrams = Diagrams::over(order, signals, MAX_NODES)?;
        Some(Self { subject, gates, diagrams, nodes: vec![None; seen.len()], work: 0 })
    }

    /// What else is free of a signal: what is remembered of it, or what it is outside of the program.
    fn free(&self, id: SignalId) -> Option<Diagram> {
        self.diagrams.signal(SignalId(self.gates.inputs.len() + id.0))
    }

    fn wire(&mut self, wire: Wire) -> Option<Diagram> {
        let mut left = vec![wire.node()];
        while let Some(&node) = left.last() {
            if self.nodes[node].is_some() {
                left.pop();
                continue;
            }
            let made = match node.checked_sub(self.gates.first_gate()) {
                None if node == 0 => Some(self.diagrams.constant(false)),
                None => Some(self.diagrams.signal(SignalId(node - 1))?),
                Some(number) => {
                    let gate = self.gates.gates[number];
                    let (Gate::And(a, b) | Gate::Xor(a, b)) = gate;
                    match (self.known(a), self.known(b)) {
                        (Some(a), Some(b)) if matches!(gate, Gate::And(..)) => Some(self.diagrams.and(&a, &b)?),
                        (Some(a), Some(b)) => Some(self.diagrams.xor(&a, &b)?),
                        _ => {
                            left.extend([b.node(), a.node()]);
                            None
                        }
                    }
                }
            };
            if let Some(made) = made {
                self.work += made.size();
                if self.work > MAX_WORK {
                    return None;
                }
                self.nodes[node] = Some(made);
                left.pop();
            }
        }
        self.known(wire)
    }

    fn known(&self, wire: Wire) -> Option<Diagram> {
        let known = self.nodes[wire.node()].as_ref()?;
        Some(if wire.is_complement() { known.complement() } else { known.clone() })
    }

    fn signals(&mut self, claim: &Claim) -> Option<Signals> {
        let subject = self.subject;
        let mut needed = FixedBitSet::with_capacity(subject.specification.signals.len());
        needed.insert(claim.signal.0);
        let add = |needed: &mut FixedBitSet, id: SignalId| needed.insert(id.0);
        for &restriction in &claim.restrictions {
            subject.specification.restrictions[restriction].allowed.each_signal(&mut |id| add(&mut needed, id));
        }
        for &id in subject.definitions.iter().rev() {
            if let (true, Kind::Defined { formula, latched, .. }) =
                (needed.contains(id.0), &subject.specification.signal(id).kind)
            {
                formula.each_signal(&mut |id| add(&mut needed, id));
                latched.iter().for_each(|reset| reset.each_signal(&mut |id| add(&mut needed, id)));
            }
        }
        let mut values = vec![None; subject.specification.signals.len()];
        for (id, variable) in subject.inputs().filter(|(id, _)| needed.contains(id.0)) {
            values[id.0] = Some(self.wire(self.gates.beginning[variable.0][0])?);
        }
        for &id in &subject.outside {
            values[id.0] = Some(self.free(id)?);
        }
        let mut wanted = None;
        for &id in subject.definitions.iter().filter(|id| needed.contains(id.0)) {
            let Kind::Defined { formula, latched, .. } = &subject.specification.signal(id).kind else { continue };
            let mut now = self.diagrams.formula(formula, &|id| values[id.0].clone())?;
            if let Some(reset) = latched {
                let reset = self.diagrams.formula(reset, &|id| values[id.0].clone())?;
                let kept = self.diagrams.and(&self.free(id)?, &reset.complement())?;
                now = self.diagrams.or(&now, &kept)?;
            }
            if id == claim.signal {
                wanted = Some(now.clone());
            }
            values[id.0] = match subject.variables[id.0].filter(|_| subject.is_delayed(id)) {
                Some(variable) => Some(self.wire(self.gates.end[variable.0][0])?),
                None => Some(now),
            };
        }
        Some(Signals { values, wanted: wanted? })
    }
}
