//! Checked program to flat code.

use std::collections::BTreeSet;

use super::{FlatProgram, Function, Instruction, Line, Operand, Target, Variable};
use crate::semantics::{self, Action, Program, Role, Statement, Type, VarId};
use crate::source::Span;
use crate::syntax::ast::key;

/// Flattens a program.
///
/// `AND( x … )` becomes `ST A`, `LD x`, …, `ST B`, `LD A`, `AND B`. There is one variable like `A` for each depth of
/// nesting, and one variable `B` for all, since its value is used at once.
#[must_use]
pub fn flatten(program: &Program) -> FlatProgram {
    let variables = program.variables.iter().map(|variable| Variable {
        name: variable.name.clone(),
        role: variable.role,
        ty: Type::BOOL,
        bits: 1,
        initial: u64::from(variable.initial),
        span: variable.span,
    });
    let mut lowering = Lowering { variables: variables.collect(), code: Vec::new(), buffers: Buffers::default() };
    let mut starts = Vec::with_capacity(program.body.len() + 1);
    for statement in &program.body {
        starts.push(lowering.code.len());
        lowering.statement(statement, 0);
    }
    starts.push(lowering.code.len());
    for line in &mut lowering.code {
        if let Instruction::Jump { target, .. } = &mut line.instruction {
            *target = starts[*target];
        }
    }
    FlatProgram { name: program.name.clone(), variables: lowering.variables, code: lowering.code }
}

struct Lowering {
    variables: Vec<Variable>,
    code: Vec<Line>,
    buffers: Buffers,
}

/// The buffers made so far.
#[derive(Default)]
struct Buffers {
    /// Holds the current result while the parenthesis of this depth is computed.
    left: Vec<VarId>,
    /// Holds the value of a parenthesis until its operator takes it.
    right: Option<VarId>,
}

impl Lowering {
    fn emit(&mut self, instruction: Instruction, span: Span) {
        self.code.push(Line { instruction, span });
    }

    fn statement(&mut self, statement: &Statement, depth: usize) {
        match &statement.action {
            // Jumps stand on the outermost level only; their targets become lines at the end.
            Action::Plain(plain) => self.emit(instruction(plain), statement.span),
            Action::Defer { function, negated, first, body, close } => {
                let left = match self.buffers.left.get(depth) {
                    Some(&left) => left,
                    None => {
                        let left = self.fresh();
                        self.buffers.left.push(left);
                        left
                    }
                };
                let right = self.buffers.right.unwrap_or_else(|| self.fresh());
                self.buffers.right = Some(right);
                self.emit(
                    Instruction::Store { ty: Type::BOOL, negated: false, target: Target::Variable(left) },
                    statement.span,
                );
                if let Some((operand, span)) = *first {
                    self.emit(
                        Instruction::Load { ty: Type::BOOL, negated: false, operand: self::operand(operand) },
                        span,
                    );
                }
                for inner in body {
                    self.statement(inner, depth + 1);
                }
                let operand = Operand::Place(Target::Variable(right));
                self.emit(
                    Instruction::Store { ty: Type::BOOL, negated: false, target: Target::Variable(right) },
                    *close,
                );
                self.emit(
                    Instruction::Load {
                        ty: Type::BOOL,
                        negated: false,
                        operand: Operand::Place(Target::Variable(left)),
                    },
                    *close,
                );
                self.emit(
                    Instruction::Combine {
                        function: self::function(*function),
                        ty: Type::BOOL,
                        negated: *negated,
                        operand,
                    },
                    *close,
                );
            }
        }
    }

    /// A new variable named by the first of A, B, …, Z, A1, B1, … that is not taken.
    fn fresh(&mut self) -> VarId {
        let taken: BTreeSet<String> = self.variables.iter().map(|variable| key(&variable.name)).collect();
        let letters =
            |round: usize| ('A'..='Z').map(move |c| if round == 0 { c.to_string() } else { format!("{c}{round}") });
        let name = (0..).flat_map(letters).find(|name| !taken.contains(name)).unwrap_or_default();
        self.variables.push(Variable { name, role: Role::Buffer, ty: Type::BOOL, bits: 1, initial: 0, span: None });
        VarId(self.variables.len() - 1)
    }
}

fn instruction(plain: &semantics::Instruction) -> Instruction {
    let ty = Type::BOOL;
    match *plain {
        semantics::Instruction::Load { negated, operand } => {
            Instruction::Load { ty, negated, operand: self::operand(operand) }
        }
        semantics::Instruction::Store { negated, variable } => {
            Instruction::Store { ty, negated, target: Target::Variable(variable) }
        }
        semantics::Instruction::Set(variable) => Instruction::Set(Target::Variable(variable)),
        semantics::Instruction::Reset(variable) => Instruction::Reset(Target::Variable(variable)),
        semantics::Instruction::Complement => Instruction::Complement(ty),
        semantics::Instruction::Combine { function, negated, operand } => {
            Instruction::Combine { function: self::function(function), ty, negated, operand: self::operand(operand) }
        }
        semantics::Instruction::Jump { condition, target } => Instruction::Jump { condition, target },
    }
}

fn operand(operand: semantics::Operand) -> Operand {
    match operand {
        semantics::Operand::Variable(variable) => Operand::Place(Target::Variable(variable)),
        semantics::Operand::Constant(value) => Operand::Constant(u64::from(value)),
    }
}

fn function(function: semantics::Function) -> Function {
    match function {
        semantics::Function::And => Function::And,
        semantics::Function::Or => Function::Or,
        semantics::Function::Xor => Function::Xor,
    }
}
