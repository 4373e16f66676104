//! Random inputs and plant moves. Equal seeds give equal runs.

use super::lots::Lots;
use super::plan::Plan;
use super::walk::Walk;
use crate::scans::ScanState;
use crate::translate::{Domain, System};
use petril_lang::flat::{Instruction, Operand};
use petril_lang::semantics::VarId;

/// A free input changes before one scan in `CHANGES`, so that effects that need several scans, such as a timer, come
/// about.
const CHANGES: u128 = 4;

/// One number in `ANY` is drawn from the whole domain; the others are near values that the program may distinguish.
const ANY: u128 = 4;

/// Generator of random plans.
#[derive(Clone, Debug)]
pub struct Chance<'s> {
    system: &'s System,
    lots: Lots,
    /// Random walk of each component of the plant.
    walks: Vec<Walk>,
    inputs: Vec<FreeInput>,
}

/// Free input with its values.
#[derive(Clone, Debug)]
struct FreeInput {
    variable: VarId,
    domain: Domain,
    /// Values at which behaviour may change: the ends of the domain, and the neighbourhood of constants of the program.
    interesting: Vec<i128>,
}

impl<'s> Chance<'s> {
    /// Creates the generator for a seed.
    #[must_use]
    pub fn new(system: &'s System, seed: u64) -> Self {
        let constants = constants(system);
        let inputs = system.free_inputs().map(|variable| {
            let domain = system.domain(variable);
            let ends = domain.ranges().iter().flat_map(|&(from, to)| [from, to]);
            let mut interesting: Vec<i128> =
                constants.iter().copied().filter(|&number| domain.contains(number)).chain(ends).collect();
            interesting.sort_unstable();
            interesting.dedup();
            FreeInput { variable, domain, interesting }
        });
        let walks = vec![Walk::default(); system.plant.components.len()];
        Self { system, lots: Lots::new(seed), walks, inputs: inputs.collect() }
    }

    /// Plan for the next scan from a state: the plant walks, some free inputs change.
    pub fn plan(&mut self, from: &ScanState) -> Plan {
        let mut plan = Plan::default();
        for (component, walk) in self.walks.iter_mut().enumerate() {
            plan.moves.extend(walk.go(self.system, component, from, &mut self.lots));
        }
        for input in &self.inputs {
            if self.lots.below(CHANGES) == 0 {
                plan.inputs.push((input.variable, input.value(from.memory[input.variable.0], &mut self.lots)));
            }
        }
        plan
    }
}

impl FreeInput {
    /// A new value: the other one of two, else a random one.
    fn value(&self, now: u64, lots: &mut Lots) -> u64 {
        if self.domain.size() == 2 {
            return self.domain.patterns().find(|&pattern| pattern != now).unwrap_or(now);
        }
        let known = if lots.below(ANY) == 0 { None } else { lots.one_of(&self.interesting).copied() };
        self.domain.ty.pattern(known.unwrap_or_else(|| nth(&self.domain, lots.below(self.domain.size()))))
    }
}

/// Value at a position of a domain.
fn nth(domain: &Domain, mut position: u128) -> i128 {
    for &(from, to) in domain.ranges() {
        let size = (to - from + 1) as u128;
        if position < size {
            return from + position as i128;
        }
        position -= size;
    }
    domain.ranges()[0].0
}

/// Constants and initial values of a program, and 0, each with its neighbours.
fn constants(system: &System) -> Vec<i128> {
    let initial = system.program.variables.iter().map(|variable| variable.ty.number(variable.initial));
    let mut numbers: Vec<i128> = initial.chain([0]).collect();
    for line in &system.program.code {
        match line.instruction {
            Instruction::Load { ty, operand: Operand::Constant(pattern), .. }
            | Instruction::Combine { ty, operand: Operand::Constant(pattern), .. } => numbers.push(ty.number(pattern)),
            Instruction::Bound { lower, upper, .. } => numbers.extend([lower, upper]),
            _ => {}
        }
    }
    numbers.sort_unstable();
    numbers.dedup();
    numbers.into_iter().flat_map(|number| [number - 1, number, number + 1]).collect()
}
