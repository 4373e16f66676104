//! Mutants: programs with a single fault, as authors of Instruction List mistype, omit and confuse.

use petril_base::source::Source;
use petril_lang::flat::{Condition, FlatProgram, Function, Instruction, Operand, Target};
use petril_lang::semantics::{Role, Type, VarId};

/// Number of inputs beyond which an operand is confused with adjacently declared ones only.
const MAX_INPUTS: usize = 16;

/// Mutant: a fault of one instruction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mutant {
    /// Line of flat code, from 0.
    pub line: usize,
    /// Class of the fault (mutation operator).
    pub class: &'static str,
    /// Instruction that replaces the original one.
    pub instruction: Instruction,
    /// Fault in words: "`ANDN ACC_Tst` becomes `AND ACC_Tst`".
    pub fault: String,
}

impl Mutant {
    /// Classes of faults, in the order of reports.
    pub const CLASSES: [&'static str; 6] =
        ["modifier", "operator", "operand", "left out", "stuck at FALSE", "stuck at TRUE"];

    /// The program with the fault.
    #[must_use]
    pub fn of(&self, program: &FlatProgram) -> FlatProgram {
        let mut program = program.clone();
        program.code[self.line].instruction = self.instruction;
        program
    }
}

/// Generates all mutants of a program. Only instructions written in its text are changed, not the expansion of a
/// function block call.
#[must_use]
pub fn mutants(program: &FlatProgram, source: &Source) -> Vec<Mutant> {
    let is_bool = |id: &VarId| program.variable(*id).ty.is_bool();
    let inputs: Vec<VarId> = program.with_role(Role::Input).filter(is_bool).collect();
    let mut found = Vec::new();
    for (line, of) in program.code.iter().enumerate().filter(|(_, of)| is_written(source.slice(of.span))) {
        let mut add = |class: &'static str, instruction: Instruction| {
            let (before, after) = (squeezed(program, of.instruction), squeezed(program, instruction));
            let fault = match class {
                "left out" => format!("`{before}` is left out"),
                _ => format!("`{before}` becomes `{after}`"),
            };
            found.push(Mutant { line, class, instruction, fault });
        };
        let gone = Instruction::Jump { condition: Condition::Always, target: line + 1 };
        let is_buffer = |place| matches!(place, Target::Variable(id) if program.variable(id).role == Role::Buffer);
        match of.instruction {
            Instruction::Load { ty: Type::BOOL, negated, operand } => {
                add("modifier", Instruction::Load { ty: Type::BOOL, negated: !negated, operand });
                let with = |operand| Instruction::Load { ty: Type::BOOL, negated, operand };
                operands(operand, &inputs, program, &mut |class, operand| add(class, with(operand)));
            }
            Instruction::Combine { function, ty: Type::BOOL, negated, operand } => {
                add("modifier", Instruction::Combine { function, ty: Type::BOOL, negated: !negated, operand });
                let own = [Function::And, Function::Or, Function::Xor];
                for other in own.into_iter().filter(|other| own.contains(&function) && *other != function) {
                    add("operator", Instruction::Combine { function: other, ty: Type::BOOL, negated, operand });
                }
                let with = |operand| Instruction::Combine { function, ty: Type::BOOL, negated, operand };
                operands(operand, &inputs, program, &mut |class, operand| add(class, with(operand)));
                add("left out", gone);
            }
            Instruction::Store { ty: Type::BOOL, negated, target } if !is_buffer(target) => {
                add("modifier", Instruction::Store { ty: Type::BOOL, negated: !negated, target });
                add("left out", gone);
            }
            Instruction::Set(target) => {
                add("operator", Instruction::Reset(target));
                add("left out", gone);
            }
            Instruction::Reset(target) => {
                add("operator", Instruction::Set(target));
                add("left out", gone);
            }
            Instruction::Complement(Type::BOOL) => add("left out", gone),
            Instruction::Jump { condition, target } if condition != Condition::Always => {
                let condition = if condition == Condition::IfTrue { Condition::IfFalse } else { Condition::IfTrue };
                add("modifier", Instruction::Jump { condition, target });
                add("left out", gone);
            }
            _ => {}
        }
    }
    found
}

/// Alternative operands: inputs it may be confused with, and constants it may be stuck at. A parenthesis has none.
fn operands(operand: Operand, inputs: &[VarId], program: &FlatProgram, add: &mut impl FnMut(&'static str, Operand)) {
    let Operand::Place(Target::Variable(own)) = operand else { return };
    if program.variable(own).role == Role::Buffer {
        return;
    }
    let position = inputs.iter().position(|&input| input == own);
    let is_near = |at: usize| inputs.len() <= MAX_INPUTS || position.is_some_and(|own| own.abs_diff(at) == 1);
    for (_, &other) in inputs.iter().enumerate().filter(|(at, other)| **other != own && is_near(*at)) {
        add("operand", Operand::Place(Target::Variable(other)));
    }
    add("stuck at FALSE", Operand::Constant(0));
    add("stuck at TRUE", Operand::Constant(1));
}

/// Whether a piece of source is an instruction that stands for itself, rather than a call.
fn is_written(text: &str) -> bool {
    let first = text.trim_start().split(|c: char| !c.is_ascii_alphabetic()).next().unwrap_or_default();
    let first = first.to_ascii_uppercase();
    let operators = ["LD", "ST", "S", "R", "NOT", "AND", "OR", "XOR", "JMPC", "JMP", "RETC", "RET"];
    operators.iter().any(|operator| first == *operator || first.strip_suffix('N') == Some(operator))
        || text.starts_with('&')
}

/// Text of an instruction with single blanks.
fn squeezed(program: &FlatProgram, instruction: Instruction) -> String {
    program.text(instruction).split_whitespace().collect::<Vec<_>>().join(" ")
}
