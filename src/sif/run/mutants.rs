//! Programs with one fault each: what people who write Instruction List mistype, forget and mix up.

use petril_base::source::Source;
use petril_lang::flat::{Condition, FlatProgram, Function, Instruction, Operand, Target};
use petril_lang::semantics::{Role, Type, VarId};

/// If there are more inputs than this, an operand is only mixed up with those declared next to it.
const MAX_INPUTS: usize = 16;

/// A fault of one instruction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mutant {
    /// The line of flat code, from 0.
    pub line: usize,
    /// What kind of fault it is.
    pub class: &'static str,
    /// What stands there instead.
    pub instruction: Instruction,
    /// What it does in words: "`ANDN ACC_Tst` becomes `AND ACC_Tst`".
    pub fault: String,
}

impl Mutant {
    /// The kinds of faults, in the order in which they are told.
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

/// All faults of a program. Only instructions that are written in its text are touched, not what a call of a function block
/// stands for.
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

/// Other operands: the inputs it could be mixed up with, and values it could be stuck at. A parenthesis has none.
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

/// Whether a piece of source is an instruction that means what it says, and no call.
fn is_written(text: &str) -> bool {
    let first = text.trim_start().split(|c: char| !c.is_ascii_alphabetic()).next().unwrap_or_default();
    let first = first.to_ascii_uppercase();
    let operators = ["LD", "ST", "S", "R", "NOT", "AND", "OR", "XOR", "JMPC", "JMP", "RETC", "RET"];
    operators.iter().any(|operator| first == *operator || first.strip_suffix('N') == Some(operator))
        || text.starts_with('&')
}

/// An instruction with one blank.
fn squeezed(program: &FlatProgram, instruction: Instruction) -> String {
    program.text(instruction).split_whitespace().collect::<Vec<_>>().join(" ")
}
