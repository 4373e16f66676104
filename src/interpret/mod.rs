//! The operational semantics (seed paper, section 2.3): states (i, m, a) of line, memory and current result, and one
//! transition for each instruction. Everything else is held to this.

use crate::flat::{FlatProgram, Instruction};
use crate::semantics::{Condition, Function, Operand, VarId};

/// A machine that executes flat code, one instruction or one scan at a time.
#[derive(Clone, Debug)]
pub struct Machine<'p> {
    program: &'p FlatProgram,
    /// i: the line to be executed next, from 0.
    line: usize,
    /// m: the value of each variable.
    memory: Vec<bool>,
    /// a: the current result, called accumulator in the paper.
    result: bool,
}

/// Why a scan has no end state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The scan never ends: the machine came back to a state it had been in since the scan began.
    Endless,
    /// The scan takes more than [`MAX_STEPS`] instructions, so nobody waited for its end.
    TooLong,
}

/// The longest scan that is executed to its end, in instructions.
pub const MAX_STEPS: usize = 1 << 26;

impl<'p> Machine<'p> {
    /// The machine at power-on: every variable has its initial value.
    #[must_use]
    pub fn new(program: &'p FlatProgram) -> Self {
        let memory = program.variables.iter().map(|variable| variable.initial).collect();
        Self { program, line: 0, memory, result: false }
    }

    /// The line to be executed next, from 0.
    #[must_use]
    pub fn line(&self) -> usize {
        self.line
    }

    /// The current result.
    #[must_use]
    pub fn result(&self) -> bool {
        self.result
    }

    /// The value of a variable.
    #[must_use]
    pub fn value(&self, variable: VarId) -> bool {
        self.memory[variable.0]
    }

    /// Gives a variable a value, as the copying of inputs does.
    pub fn set(&mut self, variable: VarId, value: bool) {
        self.memory[variable.0] = value;
    }

    /// Gives every variable a value at once; the current result becomes 0.
    pub fn restore(&mut self, memory: &[bool]) {
        self.memory.copy_from_slice(memory);
        self.result = false;
    }

    /// Whether the scan has ended.
    #[must_use]
    pub fn at_end(&self) -> bool {
        self.line == self.program.end()
    }

    /// Goes to the first line.
    pub fn begin_scan(&mut self) {
        self.line = 0;
    }

    /// Executes one instruction; nothing at the end.
    // Scans spend their time here; inlined into their loop it takes half of it.
    #[inline(always)]
    pub fn step(&mut self) {
        let Some(line) = self.program.code.get(self.line) else { return };
        self.line += 1;
        match line.instruction {
            Instruction::Load { negated, operand } => self.result = self.operand(operand) != negated,
            Instruction::Store { negated, variable } => self.memory[variable.0] = self.result != negated,
            Instruction::Set(variable) => self.memory[variable.0] |= self.result,
            Instruction::Reset(variable) => self.memory[variable.0] &= !self.result,
            Instruction::Complement => self.result = !self.result,
            Instruction::Combine { function, negated, operand } => {
                let operand = self.operand(operand) != negated;
                self.result = match function {
                    Function::And => self.result & operand,
                    Function::Or => self.result | operand,
                    Function::Xor => self.result ^ operand,
                };
            }
            Instruction::Jump { condition, target } => {
                let jumps = match condition {
                    Condition::Always => true,
                    Condition::IfTrue => self.result,
                    Condition::IfFalse => !self.result,
                };
                if jumps {
                    self.line = target;
                }
            }
        }
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
            self.step();
        }
        self.scan_with_loops()
    }

    /// Goes on with a scan that has taken more instructions than the program has.
    ///
    /// States are compared with an earlier one that is renewed at doubling distances (Brent), so a loop that repeats a state
    /// is found whatever its length.
    fn scan_with_loops(&mut self) -> Result<(), Fault> {
        let mut earlier = self.clone();
        let mut steps = self.program.end() + 1;
        let mut renew = 2 * steps;
        while !self.at_end() {
            if steps == renew {
                earlier.clone_from(self);
                renew *= 2;
            }
            self.step();
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

    /// Whether line, memory and current result are the same.
    #[must_use]
    pub fn same_state(&self, other: &Self) -> bool {
        self.line == other.line && self.result == other.result && self.memory == other.memory
    }

    fn operand(&self, operand: Operand) -> bool {
        match operand {
            Operand::Variable(variable) => self.memory[variable.0],
            Operand::Constant(value) => value,
        }
    }
}

#[cfg(test)]
mod tests;
