//! Inputs and moves of the plant by chance. The same seed gives the same run, on every machine.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::plan::{Plan, enabled};
use crate::explore::ScanState;
use crate::flat::{Instruction, Operand};
use crate::semantics::VarId;
use crate::translate::{Domain, System};

/// A free input changes before one scan in so many: what needs several scans, like a timer, should come about.
const CHANGES: u64 = 3;

/// One number in so many is any of the domain; the others lie where the program may tell numbers apart.
const ANY: u64 = 4;

/// A component moves at most so often before a scan.
const MOVES: usize = 8;

/// Makes plans by chance.
#[derive(Clone, Debug)]
pub struct Chance<'s> {
    system: &'s System,
    generator: ChaCha8Rng,
    inputs: Vec<FreeInput>,
}

/// A free input with its values.
#[derive(Clone, Debug)]
struct FreeInput {
    variable: VarId,
    domain: Domain,
    /// Values at which something may change: the ends of its domain, and those beside constants of the program.
    interesting: Vec<i128>,
}

impl<'s> Chance<'s> {
    /// The plans of a seed.
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
        Self { system, generator: ChaCha8Rng::seed_from_u64(seed), inputs: inputs.collect() }
    }

    /// What is done before the next scan from a state. Each component takes a random walk; some free inputs change.
    pub fn plan(&mut self, from: &ScanState) -> Plan {
        let mut plan = Plan::default();
        let mut plant = from.plant.clone();
        for component in 0..plant.len() {
            for _ in 0..MOVES {
                let moves: Vec<_> = enabled(self.system, from, &plant, component).collect();
                if moves.is_empty() || self.below(2) == 0 {
                    break;
                }
                let (chosen, target) = moves[self.below(moves.len() as u128) as usize];
                plan.moves.push(chosen);
                plant[component] = target;
            }
        }
        for position in 0..self.inputs.len() {
            if self.below(u128::from(CHANGES)) == 0 {
                let value = self.value(position);
                plan.inputs.push((self.inputs[position].variable, value));
            }
        }
        plan
    }

    /// A value of a free input.
    fn value(&mut self, position: usize) -> u64 {
        let (size, known) = (self.inputs[position].domain.size(), self.inputs[position].interesting.len());
        let takes_any = self.below(u128::from(ANY)) == 0;
        let choice = self.below(if takes_any { size } else { known as u128 });
        let input = &self.inputs[position];
        let number = if takes_any { nth(&input.domain, choice) } else { input.interesting[choice as usize] };
        input.domain.ty.pattern(number)
    }

    /// A number below another, which is at most 2⁶⁴.
    fn below(&mut self, limit: u128) -> u128 {
        u128::from(self.generator.next_u64()) * limit >> 64
    }
}

/// A value by its position in a domain.
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

/// The constants and initial values of a program and the numbers beside them, and those beside 0.
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
