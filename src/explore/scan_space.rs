//! The scan view: a state is what there is at the end of a scan, a step is one scan.
//!
//! A state is packed as the marking of each plant component and one bit for each declared variable. Between two scans the
//! plant makes any number of moves and free inputs take any value; then the program runs, computed by the interpreter. What
//! lies between is not stored. Leaving out the current result and the buffers is sound: the static rules see to it that
//! neither is read in a scan before it is written.

use super::space::{Failure, StateSpace, Step};
use crate::interpret::{Fault, Machine};
use crate::semantics::VarId;
use crate::translate::System;

/// The scan states of a system.
pub struct ScanSpace<'s> {
    system: &'s System,
    /// Where each plant component's marking stands in a state.
    components: Vec<Field>,
    /// Where each declared variable stands in a state.
    variables: Vec<(VarId, Field)>,
    free_inputs: Vec<VarId>,
    words: usize,
    /// The bits that make a difference to later scans: the plant's markings, what the program carries over, and the outputs
    /// the plant looks at.
    relevant: Vec<u64>,
}

/// Some bits within one word of a state.
#[derive(Clone, Copy, Debug)]
struct Field {
    word: usize,
    shift: u32,
    mask: u64,
}

impl Field {
    fn get(self, state: &[u64]) -> usize {
        (state[self.word] >> self.shift & self.mask) as usize
    }

    /// Of `value`, the bits the field has.
    fn set(self, state: &mut [u64], value: usize) {
        state[self.word] = state[self.word] & !(self.mask << self.shift) | (value as u64 & self.mask) << self.shift;
    }
}

/// A scan state in plain form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScanState {
    /// The marking of each plant component, as a position in its list of markings.
    pub plant: Vec<usize>,
    /// The values of all variables of the program; those of buffers mean nothing.
    pub memory: Vec<u64>,
}

/// One scan that was computed.
#[derive(Clone, Copy, Debug)]
pub struct ScanRun<'a> {
    /// The marking of each plant component during the scan.
    pub plant: &'a [usize],
    /// The machine at its end, or somewhere in the loop it never leaves.
    pub machine: &'a Machine<'a>,
    /// The packed state at its end, or why there is none.
    pub end: Result<&'a [u64], Fault>,
}

impl<'s> ScanSpace<'s> {
    /// The space of a system.
    #[must_use]
    pub fn new(system: &'s System) -> Self {
        let mut used: Vec<u32> = vec![0];
        let mut field = |bits: u32| {
            if used.last().is_some_and(|&used| used + bits > 64) {
                used.push(0);
            }
            let word = used.len() - 1;
            let shift = used[word];
            used[word] += bits;
            // A field of no bits is never shifted by 64.
            Field { word, shift: shift.min(63), mask: (1 << bits) - 1 }
        };
        let width = |markings: usize| usize::BITS - (markings - 1).leading_zeros();
        let components: Vec<Field> = system.plant.components.iter().map(|c| field(width(c.markings.len()))).collect();
        let variables: Vec<(VarId, Field)> = system.program.declared().map(|variable| (variable, field(1))).collect();
        let words = used.len();
        let mut carried = system.program.carried();
        carried.extend(system.plant.tested().map(|output| output.0));
        let mut relevant = vec![0; words];
        components.iter().for_each(|field| field.set(&mut relevant, usize::MAX));
        for (_, field) in variables.iter().filter(|(variable, _)| carried.contains(variable.0)) {
            field.set(&mut relevant, 1);
        }
        Self { system, components, variables, free_inputs: system.free_inputs().collect(), words, relevant }
    }

    /// The system.
    #[must_use]
    pub fn system(&self) -> &'s System {
        self.system
    }

    /// A state in plain form.
    #[must_use]
    pub fn unpack(&self, state: &[u64]) -> ScanState {
        let mut memory = vec![0; self.system.program.variables.len()];
        for &(variable, field) in &self.variables {
            memory[variable.0] = field.get(state) as u64;
        }
        ScanState { plant: self.components.iter().map(|field| field.get(state)).collect(), memory }
    }

    /// The value of a declared variable in a state.
    #[must_use]
    pub fn value(&self, state: &[u64], variable: VarId) -> u64 {
        // Declared variables come first in a program, in this order.
        self.variables[variable.0].1.get(state) as u64
    }

    /// The system at power-on, before the first scan. It is no scan state.
    #[must_use]
    pub fn power_on(&self) -> ScanState {
        ScanState {
            plant: vec![0; self.components.len()],
            memory: self.system.program.variables.iter().map(|variable| variable.initial).collect(),
        }
    }

    fn pack(&self, plant: &[usize], machine: &Machine<'_>, state: &mut [u64]) {
        state.fill(0);
        self.components.iter().zip(plant).for_each(|(field, &marking)| field.set(state, marking));
        self.variables.iter().for_each(|&(variable, field)| field.set(state, machine.value(variable) as usize));
    }

    /// For each component, the markings it can be in when the next scan begins.
    fn plant_choices(&self, from: &ScanState) -> Vec<Vec<usize>> {
        let components = self.system.plant.components.iter().zip(&from.plant);
        components
            .map(|(component, &marking)| {
                let closure = component.closure(marking, |output| from.memory[output.0]);
                closure.into_iter().map(|(marking, _)| marking).collect()
            })
            .collect()
    }

    /// Calls `visit` for the scan from a state under each choice of plant markings and free inputs.
    pub fn scans(&self, from: &ScanState, visit: &mut dyn FnMut(ScanRun<'_>)) {
        let choices = self.plant_choices(from);
        let mut state = vec![0; self.words];
        let mut machine = Machine::new(&self.system.program);
        let mut odometer = vec![0; choices.len()];
        let mut plant = vec![0; choices.len()];
        loop {
            for (slot, (choice, &digit)) in plant.iter_mut().zip(choices.iter().zip(&odometer)) {
                *slot = choice[digit];
            }
            for free in 0..1_u64 << self.free_inputs.len() {
                machine.restore(&from.memory);
                for (component, &marking) in self.system.plant.components.iter().zip(&plant) {
                    component.markings[marking].inputs.iter().for_each(|&(input, value)| machine.set(input, value));
                }
                for (bit, &input) in self.free_inputs.iter().rev().enumerate() {
                    machine.set(input, free >> bit & 1);
                }
                let result = machine.scan();
                self.pack(&plant, &machine, &mut state);
                visit(ScanRun { plant: &plant, machine: &machine, end: result.map(|()| state.as_slice()) });
            }
            // The next combination of plant markings, the last component fastest.
            let Some(turn) = odometer.iter().zip(&choices).rposition(|(&digit, choice)| digit + 1 < choice.len())
            else {
                return;
            };
            odometer[turn] += 1;
            odometer[turn + 1..].fill(0);
        }
    }
}

impl StateSpace for ScanSpace<'_> {
    fn words(&self) -> usize {
        self.words
    }

    fn initial(&self, visit: &mut dyn FnMut(Step<'_>)) {
        self.scans(&self.power_on(), &mut |run| visit(step(run.end)));
    }

    fn successors(&self, state: &[u64], visit: &mut dyn FnMut(Step<'_>)) {
        self.scans(&self.unpack(state), &mut |run| visit(step(run.end)));
    }

    fn relevant(&self) -> Option<&[u64]> {
        Some(&self.relevant)
    }

    fn fan_out(&self, state: Option<&[u64]>) -> u64 {
        let from = state.map_or_else(|| self.power_on(), |state| self.unpack(state));
        let free = 1_u64.checked_shl(self.free_inputs.len() as u32).unwrap_or(u64::MAX);
        self.plant_choices(&from).iter().fold(free, |product, choice| product.saturating_mul(choice.len() as u64))
    }
}

fn step(end: Result<&[u64], Fault>) -> Step<'_> {
    match end {
        Ok(state) => Step::To(state),
        Err(fault) => Step::Fails(Failure::Scan(fault)),
    }
}
