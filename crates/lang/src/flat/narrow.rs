//! Narrowing: bounds on the number of bits of each variable that can ever be other than 0.

use std::collections::BTreeSet;

use super::{FlatProgram, Instruction, Operand, Target};
use crate::semantics::{Role, VarId};

/// Clock of a timer, which stays below the greatest preset time plus one step.
#[derive(Clone, Copy, Debug)]
pub struct Timer {
    /// Variable of the clock.
    pub clock: VarId,
    /// Variable of the preset time.
    pub preset: VarId,
    /// Advance of the clock in one scan, in milliseconds.
    pub step: u64,
    /// Line that compares the clock with the preset time before it advances.
    pub line: usize,
}

/// Number of raises of a variable's bound after which any value is assumed (widening).
const MAX_RAISES: usize = 1000;

/// Narrows the variables that are only given constants and copies: `preset := T#200ms` needs 8 bits, not 32.
pub fn narrow(program: &mut FlatProgram, timers: &[Timer]) {
    let targets: BTreeSet<usize> = program
        .code
        .iter()
        .filter_map(|line| match line.instruction {
            Instruction::Jump { target, .. } => Some(target),
            _ => None,
        })
        .collect();
    let mask = |id: usize| u64::MAX >> (64 - program.variables[id].bits);
    let mut greatest: Vec<u64> = program.variables.iter().map(|variable| variable.initial).collect();
    for (id, variable) in program.variables.iter().enumerate() {
        if variable.role == Role::Input {
            greatest[id] = mask(id);
        }
    }
    // For each variable, the variables that get a copy of it, each with the number added.
    let mut copies: Vec<Vec<(usize, u64)>> = vec![Vec::new(); program.variables.len()];
    let clocks: BTreeSet<usize> = timers.iter().map(|timer| timer.clock.0).collect();
    for timer in timers {
        copies[timer.preset.0].push((timer.clock.0, timer.step));
    }
    for (line, code) in program.code.iter().enumerate() {
        let Instruction::Store { target, negated, .. } = code.instruction else { continue };
        let written = variables(target);
        match source(program, line, &targets).filter(|_| !negated) {
            Some(Operand::Constant(pattern)) => {
                written.iter().for_each(|&id| greatest[id] = greatest[id].max(pattern));
            }
            Some(Operand::Place(read)) => {
                for from in variables(read) {
                    copies[from].extend(written.iter().map(|&id| (id, 0)));
                }
            }
            None => {
                let computed = written.iter().filter(|id| !clocks.contains(id));
                computed.for_each(|&id| greatest[id] = mask(id));
            }
        }
    }
    let mut work: Vec<usize> = (0..greatest.len()).collect();
    let mut raised = vec![0; greatest.len()];
    while let Some(from) = work.pop() {
        for &(to, more) in &copies[from] {
            // A bound as wide as its type may stand for a negative number; then nothing is known.
            let value = greatest[from].saturating_add(more).min(mask(to));
            if value > greatest[to] {
                raised[to] += 1;
                // A clock that sets its own preset time advances for ever, step by step.
                greatest[to] = if raised[to] > MAX_RAISES { mask(to) } else { value };
                work.push(to);
            }
        }
    }
    for timer in timers {
        // Beyond the greatest preset time the clock need not count. As a pattern above the least signed one, it may be negative.
        let preset = greatest[timer.preset.0];
        if preset < 1 << 31
            && let Instruction::Combine { operand, .. } = &mut program.code[timer.line].instruction
        {
            *operand = Operand::Constant(preset);
        } else {
            program.presets_vary = true;
        }
    }
    for (variable, greatest) in program.variables.iter_mut().zip(greatest) {
        variable.bits = variable.bits.min((u64::BITS - greatest.leading_zeros()).max(1));
    }
}

/// Operand that the current result was loaded from when a line stores it, if no other line can have changed it.
fn source(program: &FlatProgram, line: usize, targets: &BTreeSet<usize>) -> Option<Operand> {
    let mut at = line;
    while !targets.contains(&at) && at > 0 {
        at -= 1;
        match program.code[at].instruction {
            Instruction::Load { negated: false, operand, .. } => return Some(operand),
            Instruction::Store { .. } | Instruction::Bound { .. } => {}
            _ => return None,
        }
    }
    None
}

fn variables(target: Target) -> Vec<usize> {
    match target {
        Target::Variable(variable) => vec![variable.0],
        Target::Element(element) => element.all().map(|id| id.0).collect(),
    }
}
