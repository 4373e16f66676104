//! The operational semantics (seed paper, section 2.3): states (i, m, a) of line, memory and current result, and one
//! transition for each instruction. The reference for everything else.

mod arithmetic;

use crate::flat::{Condition, FlatProgram, Function, Hazard, Instruction, Operand, Target};
use crate::semantics::{Type, VarId};
use arithmetic::{combine, convert};

/// Interpreter that executes flat code, one instruction or one scan at a time.
#[derive(Clone, Debug)]
pub struct Machine<'p> {
    program: &'p FlatProgram,
    /// i: the line to be executed next, from 0.
    line: usize,
    /// m: the value of each variable, as a pattern of its type.
    memory: Vec<u64>,
    /// a: the current result, called accumulator in the paper.
    result: u64,
    /// Hazards met in this scan, each with its line (from 0), in the order of time.
    hazards: Vec<(usize, Hazard)>,
}

/// Reason why a scan has no end state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The scan never ends: the machine came back to a state it had been in since the scan began.
    Endless,
    /// The scan takes more than [`MAX_STEPS`] instructions and was given up.
    TooLong,
}

/// Longest scan that is executed to its end, in instructions.
pub const MAX_STEPS: usize = 1 << 26;

impl<'p> Machine<'p> {
    /// Creates the machine at power-on: every variable has its initial value.
    #[must_use]
    pub fn new(program: &'p FlatProgram) -> Self {
        let memory = program.variables.iter().map(|variable| variable.initial).collect();
        Self { program, line: 0, memory, result: 0, hazards: Vec::new() }
    }

    /// The line to be executed next, from 0.
    #[must_use]
    pub fn line(&self) -> usize {
        self.line
    }

    /// The current result. Only as many bits are meaningful as the type of the instruction before has.
    #[must_use]
    pub fn result(&self) -> u64 {
        self.result
    }

    /// Value of a variable, as a pattern of its type.
    #[must_use]
    pub fn value(&self, variable: VarId) -> u64 {
        self.memory[variable.0]
    }

    /// Values of all variables, as patterns of their types.
    #[must_use]
    pub fn memory(&self) -> &[u64] {
        &self.memory
    }

    /// Sets the value of a variable, as the copying of inputs does.
    pub fn set(&mut self, variable: VarId, value: u64) {
        self.memory[variable.0] = value;
    }

    /// Sets the values of all variables; the current result becomes 0.
    pub fn restore(&mut self, memory: &[u64]) {
        self.memory.copy_from_slice(memory);
        self.result = 0;
    }

    /// Whether the scan has ended.
    #[must_use]
    pub fn at_end(&self) -> bool {
        self.line == self.program.end()
    }

    /// Goes to the first line and forgets the hazards of the last scan.
    pub fn begin_scan(&mut self) {
        self.line = 0;
        self.hazards.clear();
    }

    /// The hazards that [`Machine::scan`] met in its last scan, each with its line (from 0), in the order of time.
    #[must_use]
    pub fn hazards(&self) -> &[(usize, Hazard)] {
        &self.hazards
    }

    /// Executes one instruction and records the hazard it meets.
    #[inline(always)]
    fn run(&mut self) {
        let line = self.line;
        if let Some(hazard) = self.step() {
            self.hazards.push((line, hazard));
        }
    }

    /// Executes one instruction, or none at the end of the scan; returns the hazard it met.
    // Scans spend their time here; inlining halves the time of their loop.
    #[inline(always)]
    pub fn step(&mut self) -> Option<Hazard> {
        let line = self.program.code.get(self.line)?;
        self.line += 1;
        match line.instruction {
            Instruction::Load { ty, negated, operand } => self.result = complement(ty, negated, self.operand(operand)),
            Instruction::Store { ty, negated, target } => {
                let variable = self.variable(target);
                self.memory[variable.0] = complement(ty, negated, self.result);
            }
            Instruction::Set(target) => {
                let variable = self.variable(target);
                self.memory[variable.0] |= self.result;
            }
            Instruction::Reset(target) => {
                let variable = self.variable(target);
                self.memory[variable.0] &= !self.result;
            }
            Instruction::Complement(ty) => self.result = complement(ty, true, self.result),
            Instruction::Combine { function, ty, negated, operand } => {
                let operand = complement(ty, negated, self.operand(operand));
                let (result, hazard) = match function {
                    Function::And => (self.result & operand, None),
                    Function::Or => (self.result | operand, None),
                    Function::Xor => (self.result ^ operand, None),
                    _ => combine(function, ty, self.result, operand),
                };
                self.result = result;
                return hazard;
            }
            Instruction::Convert { from, to } => {
                let (result, hazard) = convert(from, to, self.result);
                self.result = result;
                return hazard;
            }
            Instruction::Bound { ty, lower, upper, hazard } => {
                if !(lower..=upper).contains(&ty.number(self.result)) {
                    if hazard == Hazard::Index {
                        self.result = ty.pattern(lower);
                    }
                    return Some(hazard);
                }
            }
            Instruction::Jump { condition, target } => {
                let jumps = match condition {
                    Condition::Always => true,
                    Condition::IfTrue => self.result == 1,
                    Condition::IfFalse => self.result == 0,
                };
                if jumps {
                    self.line = target;
                }
            }
        }
        None
    }

    /// Executes a whole scan from the first line. The inputs must have been set.
    ///
    /// # Errors
    /// A [`Fault`] if the scan does not end; the machine is then somewhere in its loop.
    pub fn scan(&mut self) -> Result<(), Fault> {
        self.begin_scan();
        // Code without loops ends within its length.
        for _ in 0..=self.program.end() {
            if self.at_end() {
                return Ok(());
            }
            self.run();
        }
        self.scan_with_loops()
    }

    /// Continues a scan that has taken more instructions than the program has.
    ///
    /// States are compared with an earlier one that is renewed at doubling distances (Brent's cycle detection), so a
    /// loop that repeats a state is found whatever its length.
    fn scan_with_loops(&mut self) -> Result<(), Fault> {
        let mut earlier = self.clone();
        let mut steps = self.program.end() + 1;
        let mut renew = 2 * steps;
        while !self.at_end() {
            if steps == renew {
                earlier.clone_from(self);
                renew *= 2;
            }
            self.run();
            steps += 1;
            if self.same_state(&earlier) {
                return Err(Fault::Endless);
            }
            if steps >= MAX_STEPS {
                return Err(Fault::TooLong);
            }
        }
        Ok(())
    }

    /// Whether line, memory and current result are those of the other machine.
    #[must_use]
    pub fn same_state(&self, other: &Self) -> bool {
        self.line == other.line && self.result == other.result && self.memory == other.memory
    }

    fn operand(&self, operand: Operand) -> u64 {
        match operand {
            Operand::Place(target) => self.memory[self.variable(target).0],
            Operand::Constant(pattern) => pattern,
        }
    }

    /// Variable that a target denotes in the present memory.
    fn variable(&self, target: Target) -> VarId {
        match target {
            Target::Variable(variable) => variable,
            Target::Element(element) => element.at(self.memory[element.index.0] as usize),
        }
    }
}

fn complement(ty: Type, negated: bool, value: u64) -> u64 {
    if negated { !value & ty.mask() } else { value }
}

#[cfg(test)]
mod order;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod written_out;
