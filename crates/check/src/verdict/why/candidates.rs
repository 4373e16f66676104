//! Candidate input changes for a repair: inputs of the run and the values to try instead.

use std::cmp::Reverse;
use std::collections::BTreeSet;

use super::Broken;
use crate::scans::{Position, ScanSpace};
use crate::verdict::Change;
use crate::verdict::coverage::read;
use crate::witness::ScanTrace;
use petril_lang::flat::{Instruction, Operand};
use petril_lang::semantics::{Type, VarId};

/// Upper bound on values of an input, or markings of a device, that are tried exhaustively.
const ALL: usize = 32;

/// A free input, or all inputs driven by one device, in one scan, with the alternatives to try.
pub struct Slot {
    /// The scan.
    pub scan: usize,
    /// Inputs with their values in this scan.
    now: Vec<(VarId, u64)>,
    /// Alternatives: one change for a free input, one or more for a device.
    pub alternatives: Vec<Vec<Change>>,
}

impl Slot {
    /// Changes that give the inputs these values.
    pub fn changed_to(&self, values: &[(VarId, u64)]) -> Vec<Change> {
        let now = self.now.iter().filter_map(|&(input, from)| {
            let &(_, to) = values.iter().find(|(own, _)| *own == input)?;
            Some(Change { scan: self.scan, input, from, to })
        });
        now.filter(|change| change.from != change.to).collect()
    }
}

/// Slots of a run, later scans first; within a scan, inputs that have just changed first.
pub struct Candidates {
    pub slots: Vec<Slot>,
    /// Whether the alternatives are exhaustive.
    pub are_all: bool,
}

/// Collects the candidates of a run. `ends` are the positions after each of its scans.
pub fn candidates(broken: &Broken<'_>, space: &ScanSpace<'_>, trace: &ScanTrace, ends: &[Position]) -> Candidates {
    let system = space.system();
    let program = &system.program;
    let mentions = broken.formula.mentions();
    let mut relevant = read(program);
    relevant.extend(&mentions.variables);
    let mut candidates = Candidates { slots: Vec::new(), are_all: true };
    let free: Vec<VarId> = system.free_inputs().filter(|input| relevant.contains(input)).collect();
    let (beginning, numbers) = (space.beginning(), mentions.numbers);
    let elsewhere: Vec<Vec<u64>> = free.iter().map(|&input| distinct(input, trace)).collect();
    for (scan, told) in trace.scans.iter().enumerate().rev() {
        let now = |input: VarId| told.inputs.iter().find(|(own, _)| *own == input).map_or(0, |&(_, value)| value);
        let change = |input: VarId, to: u64| Change { scan, input, from: now(input), to };
        for (&input, elsewhere) in free.iter().zip(&elsewhere) {
            let (values, are_all) = values(space, input, now(input), &numbers, elsewhere);
            candidates.are_all &= are_all;
            let ty = system.program.variable(input).ty;
            let mut alternatives: Vec<Vec<Change>> = values.into_iter().map(|to| vec![change(input, to)]).collect();
            alternatives.sort_by_key(|changes| apart(ty, &changes[0]));
            candidates.slots.push(Slot { scan, now: vec![(input, now(input))], alternatives });
        }
        let before = scan.checked_sub(1).map_or(&beginning, |earlier| &ends[earlier]);
        for (number, component) in system.plant.components.iter().enumerate() {
            let Some(first) = component.markings.first() else { continue };
            if !first.inputs.iter().any(|(input, _)| relevant.contains(input)) {
                continue;
            }
            let differing = |marking: usize| -> Vec<Change> {
                let inputs = component.markings[marking].inputs.iter();
                inputs.filter(|&&(input, to)| now(input) != to).map(|&(input, to)| change(input, to)).collect()
            };
            let all = (0..component.markings.len()).map(differing);
            let mut alternatives: Vec<Vec<Change>> = if component.markings.len() <= ALL {
                all.collect()
            } else {
                // After other changes the device may reach more markings.
                candidates.are_all = false;
                let ahead = before.plant[number].iter();
                let ahead = ahead.flat_map(|&marking| component.closure(marking, |output| before.memory[output.0]));
                ahead.take(ALL).map(|(marking, _)| differing(marking)).collect()
            };
            alternatives.retain(|changes| !changes.is_empty());
            alternatives.sort_by_key(|changes| {
                let apart = changes.iter().map(|change| apart(system.program.variable(change.input).ty, change));
                (apart.sum::<u128>(), changes.iter().map(|change| (change.input, change.to)).collect::<Vec<_>>())
            });
            alternatives.dedup();
            let now = first.inputs.iter().map(|&(input, _)| (input, now(input))).collect();
            candidates.slots.push(Slot { scan, now, alternatives });
        }
    }
    candidates.slots.retain(|slot| !slot.alternatives.is_empty());
    // Inputs that have just changed are the likeliest cause.
    let earlier = |scan: usize, input: VarId| match scan.checked_sub(1) {
        Some(before) => ends[before].memory[input.0],
        None => program.variable(input).initial,
    };
    let stayed = |slot: &Slot| slot.now.iter().all(|&(input, value)| earlier(slot.scan, input) == value);
    candidates.slots.sort_by_key(|slot| (Reverse(slot.scan), stayed(slot)));
    candidates
}

/// First distinct values of an input in a run, up to the number tried.
fn distinct(input: VarId, trace: &ScanTrace) -> Vec<u64> {
    let mut values = Vec::new();
    for &(_, value) in trace.scans.iter().flat_map(|scan| &scan.inputs).filter(|(own, _)| *own == input) {
        if values.len() < ALL && !values.contains(&value) {
            values.push(value);
        }
    }
    values
}

/// Distance between the values of a change. The nearest are tried first.
fn apart(ty: Type, change: &Change) -> u128 {
    (ty.number(change.to) - ty.number(change.from)).unsigned_abs()
}

/// Alternative values of a free input, and whether they are exhaustive. For a large domain: its other values in the
/// run, the ends of the domain, 0, the constants it may be compared with, and the neighbours of all these and of its
/// own value.
fn values(
    space: &ScanSpace<'_>,
    input: VarId,
    now: u64,
    numbers: &BTreeSet<i128>,
    elsewhere: &[u64],
) -> (Vec<u64>, bool) {
    let system = space.system();
    let (domain, ty) = (system.domain(input), system.program.variable(input).ty);
    if domain.size() <= ALL as u128 {
        return (domain.patterns().filter(|&value| value != now).collect(), true);
    }
    let mut near: Vec<i128> = elsewhere.iter().map(|&value| ty.number(value)).collect();
    let ends = domain.ranges().iter().flat_map(|&(from, to)| [from, to]);
    near.extend(ends.take(4).chain([0, ty.number(now)]));
    near.extend(numbers);
    near.extend(system.program.code.iter().filter_map(|code| match code.instruction {
        Instruction::Combine { operand: Operand::Constant(value), ty: own, .. }
        | Instruction::Load { operand: Operand::Constant(value), ty: own, .. } => (own == ty).then(|| ty.number(value)),
        _ => None,
    }));
    let mut values = BTreeSet::new();
    for number in near.into_iter().flat_map(|number| [number, number + 1, number - 1]) {
        if domain.contains(number) && values.len() < ALL {
            values.insert(ty.pattern(number));
        }
    }
    values.remove(&now);
    (values.into_iter().collect(), false)
}
