//! Unrolling of scans in a solver: gates of the program and formulas of the specification as literals.

use fixedbitset::FixedBitSet;

use super::run::Given;
use super::subject::{Form, Subject};
use crate::sif::{Kind, Literal, Solver};
use petril_lang::circuit::{Gate, ScanGates, Wire};
use petril_lang::semantics::Role;

/// Cone of influence of the claims in the gates of a scan.
pub(super) struct Network<'a> {
    pub(super) subject: &'a Subject<'a>,
    pub(super) gates: &'a ScanGates,
    /// Nodes that the claims depend on.
    needed: FixedBitSet,
    /// Numbers of the network inputs that are carried from scan to scan and that the claims depend on.
    pub(super) carried: Vec<usize>,
}

impl<'a> Network<'a> {
    pub(super) fn new(subject: &'a Subject<'a>, gates: &'a ScanGates) -> Self {
        let program = subject.program;
        let mut needed = FixedBitSet::with_capacity(gates.first_gate() + gates.gates.len());
        let mut left: Vec<Wire> = gates.errors.iter().map(|(wire, ..)| *wire).collect();
        let claimed = subject.claims.iter().map(|claim| claim.variable);
        // A delayed output is used as the program computes it.
        let delayed = subject.definitions.iter().filter(|id| subject.is_delayed(**id));
        let seen = delayed.filter_map(|id| subject.variables[id.0]);
        left.extend(claimed.chain(seen).map(|variable| gates.end[variable.0][0]));
        let mut carried = Vec::new();
        while let Some(wire) = left.pop() {
            let node = wire.node();
            if needed.put(node) || node == 0 {
                continue;
            }
            if let Some(number) = node.checked_sub(gates.first_gate()) {
                let (Gate::And(a, b) | Gate::Xor(a, b)) = gates.gates[number];
                left.extend([a, b]);
            } else {
                let (variable, bit) = gates.inputs[node - 1];
                if program.variable(variable).role != Role::Input {
                    carried.push(node - 1);
                    left.push(gates.end[variable.0][bit as usize]);
                }
            }
        }
        carried.sort_unstable();
        Self { subject, gates, needed, carried }
    }

    /// Initial state.
    pub(super) fn power_on(&self, solver: &Solver) -> State {
        let bit = |&number: &usize| {
            let (variable, bit) = self.gates.inputs[number];
            solver.constant(self.subject.program.variable(variable).initial >> bit & 1 == 1)
        };
        let latches = self.latched().map(|_| solver.constant(false)).collect();
        State { bits: self.carried.iter().map(bit).collect(), latches }
    }

    /// Arbitrary state, reachable or not.
    pub(super) fn any_state(&self, solver: &mut Solver) -> State {
        let bits = self.carried.iter().map(|_| solver.fresh()).collect();
        State { bits, latches: self.latched().map(|_| solver.fresh()).collect() }
    }

    /// Positions of the latched definitions.
    fn latched(&self) -> impl Iterator<Item = usize> {
        let definitions = self.subject.definitions.iter().enumerate();
        definitions.filter(|(_, id)| self.subject.latch(**id).is_some()).map(|(position, _)| position)
    }

    /// Encodes one scan from a state.
    pub(super) fn scan(&self, solver: &mut Solver, start: &State) -> Frame {
        let (subject, gates, program) = (self.subject, self.gates, self.subject.program);
        let no = solver.constant(false);
        let mut nodes = vec![no; gates.first_gate() + gates.gates.len()];
        self.carried.iter().zip(&start.bits).for_each(|(&number, &bit)| nodes[1 + number] = bit);
        for (number, &(variable, _)) in gates.inputs.iter().enumerate() {
            if program.variable(variable).role == Role::Input {
                nodes[1 + number] = solver.fresh();
            }
        }
        let at = |nodes: &[Literal], wire: Wire| {
            let literal = nodes[wire.node()];
            if wire.is_complement() { !literal } else { literal }
        };
        for &variable in program.restrictions.keys() {
            let declared = program.variable(variable);
            if declared.role == Role::Input {
                let bits: Vec<Literal> = gates.beginning[variable.0].iter().map(|&wire| at(&nodes, wire)).collect();
                let (least, greatest) = program.range(variable);
                is_between(solver, &bits, declared.ty.is_signed(), least, greatest);
            }
        }
        for (number, gate) in gates.gates.iter().enumerate() {
            let node = gates.first_gate() + number;
            if self.needed.contains(node) {
                nodes[node] = match *gate {
                    Gate::And(a, b) => solver.and([at(&nodes, a), at(&nodes, b)]),
                    Gate::Xor(a, b) => solver.xor(at(&nodes, a), at(&nodes, b)),
                };
            }
        }
        let mut signals = vec![no; subject.specification.signals.len()];
        for (id, variable) in subject.inputs() {
            signals[id.0] = at(&nodes, gates.beginning[variable.0][0]);
        }
        let outside: Vec<Literal> = subject.outside.iter().map(|_| solver.fresh()).collect();
        subject.outside.iter().zip(&outside).for_each(|(id, &literal)| signals[id.0] = literal);
        let mut wanted = signals.clone();
        let mut latches = Vec::new();
        for &id in &subject.definitions {
            let Kind::Defined { formula, latched, .. } = &subject.specification.signal(id).kind else { continue };
            let mut now = solver.formula(formula, &|signal| signals[signal.0]);
            if let Some(reset) = latched {
                let reset = solver.formula(reset, &|signal| signals[signal.0]);
                let kept = solver.and([start.latches[latches.len()], !reset]);
                now = solver.or([now, kept]);
                latches.push(now);
            }
            wanted[id.0] = now;
            let made = subject.variables[id.0].filter(|_| subject.is_delayed(id));
            signals[id.0] = made.map_or(now, |variable| at(&nodes, gates.end[variable.0][0]));
        }
        let restrictions = subject.restrictions.iter().map(|&position| {
            let allowed = &subject.specification.restrictions[position].allowed;
            solver.formula(allowed, &|signal| signals[signal.0])
        });
        let allowed = restrictions.collect();
        let errors: Vec<Literal> = gates.errors.iter().map(|(wire, ..)| at(&nodes, *wire)).collect();
        let fails = solver.or(errors.iter().copied());
        let claims = subject.claims.iter().map(|claim| {
            let (is, wanted) = (at(&nodes, gates.end[claim.variable.0][0]), wanted[claim.signal.0]);
            match claim.form {
                Form::Equal | Form::Latched => solver.xor(is, wanted),
                Form::NotWithout => solver.and([is, !wanted]),
            }
        });
        let wrong = claims.collect();
        let end = |&number: &usize| {
            let (variable, bit) = gates.inputs[number];
            at(&nodes, gates.end[variable.0][bit as usize])
        };
        let end = State { bits: self.carried.iter().map(end).collect(), latches };
        let inputs = nodes[1..gates.first_gate()].to_vec();
        Frame { start: start.clone(), inputs, outside, allowed, errors, fails, wrong, end }
    }

    /// Inputs of a scan in the model found last.
    pub(super) fn given(&self, solver: &Solver, frame: &Frame) -> Given {
        let program = self.subject.program;
        let mut inputs: Vec<_> = program.with_role(Role::Input).map(|input| (input, 0_u64)).collect();
        for (&(variable, bit), &literal) in self.gates.inputs.iter().zip(&frame.inputs) {
            if let Ok(at) = inputs.binary_search_by_key(&variable, |(input, _)| *input) {
                inputs[at].1 |= u64::from(solver.value(literal)) << bit;
            }
        }
        let outside = self.subject.outside.iter().zip(&frame.outside);
        Given { inputs, outside: outside.map(|(&id, &literal)| (id, solver.value(literal))).collect() }
    }
}

/// State carried from one scan to the next.
#[derive(Clone)]
pub(super) struct State {
    /// Carried bits of the program.
    bits: Vec<Literal>,
    /// Latches of the specification.
    latches: Vec<Literal>,
}

impl State {
    /// Requires two states to differ.
    pub(super) fn differ(&self, other: &Self, solver: &mut Solver) {
        let pairs = self.bits.iter().zip(&other.bits).chain(self.latches.iter().zip(&other.latches));
        let differ: Vec<Literal> = pairs.map(|(&a, &b)| solver.xor(a, b)).collect();
        solver.require(differ);
    }

    /// Number of bits.
    pub(super) fn bits(&self) -> usize {
        self.bits.len() + self.latches.len()
    }
}

/// Unrolled scan.
pub(super) struct Frame {
    pub(super) start: State,
    /// Literal of each input of the network.
    inputs: Vec<Literal>,
    outside: Vec<Literal>,
    /// Whether the scan satisfies each of the subject's restrictions.
    pub(super) allowed: Vec<Literal>,
    /// Whether the scan meets each of the errors.
    pub(super) errors: Vec<Literal>,
    /// Whether the scan meets any error.
    pub(super) fails: Literal,
    /// Whether each of the claims is violated at the end of the scan.
    pub(super) wrong: Vec<Literal>,
    pub(super) end: State,
}

/// Requires a number to lie between two bounds.
fn is_between(solver: &mut Solver, bits: &[Literal], is_signed: bool, least: i128, greatest: i128) {
    // Inverting the sign bit maps a signed number to an unsigned one, increased by this offset.
    let offset = if is_signed { 1_i128 << (bits.len() - 1) } else { 0 };
    let mut bits = bits.to_vec();
    if let (true, Some(sign)) = (is_signed, bits.last_mut()) {
        *sign = !*sign;
    }
    let (least, greatest) = (least + offset, greatest + offset);
    // From the highest bit: while the number equals the bound so far, its next bit must not pass the bound.
    let (mut as_least, mut as_greatest) = (solver.constant(true), solver.constant(true));
    for (position, &bit) in bits.iter().enumerate().rev() {
        if least >> position & 1 == 1 {
            solver.require([!as_least, bit]);
            as_least = solver.and([as_least, bit]);
        } else {
            as_least = solver.and([as_least, !bit]);
        }
        if greatest >> position & 1 == 0 {
            solver.require([!as_greatest, !bit]);
            as_greatest = solver.and([as_greatest, !bit]);
        } else {
            as_greatest = solver.and([as_greatest, bit]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sif::Answer;

    /// Every range of numbers of 4 bits: a number is left exactly if it lies in the range.
    #[test]
    fn numbers_in_their_range_are_left_and_no_others() {
        const BITS: u32 = 4;
        for is_signed in [false, true] {
            let first = if is_signed { -8 } else { 0 };
            for (least, greatest) in
                (first..first + 16).flat_map(|least| (least..first + 16).map(move |to| (least, to)))
            {
                let mut solver = Solver::default();
                let bits: Vec<Literal> = (0..BITS).map(|_| solver.fresh()).collect();
                is_between(&mut solver, &bits, is_signed, least, greatest);
                for number in first..first + 16 {
                    let has =
                        |(position, &bit): (usize, &Literal)| if number >> position & 1 == 1 { bit } else { !bit };
                    let assumed: Vec<Literal> = bits.iter().enumerate().map(has).collect();
                    let is_left = solver.solve(&assumed) == Answer::Satisfiable;
                    assert_eq!(is_left, (least..=greatest).contains(&number), "{number} in {least}..{greatest}");
                }
            }
        }
    }
}
