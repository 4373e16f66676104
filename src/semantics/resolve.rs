//! Builds the checked program once every rule is satisfied.

use super::control_flow;
use super::program::{Action, Function, Instruction, Operand, Program, Statement, Variable};
use super::{Context, Symbols};
use crate::syntax::ast::{self, Operation, Operator, Verb};

/// The checked program. `None` would mean that a rule let something pass that has no meaning.
pub fn program(context: &Context<'_>) -> Option<Program> {
    let symbols = context.symbols;
    let variables = symbols.list().iter().map(|symbol| {
        Some(Variable {
            name: symbol.name.text.clone(),
            role: symbol.role?,
            initial: symbol.initial.is_some_and(|initial| initial.boolean == Some(true)),
            span: Some(symbol.name.span),
        })
    });
    let body = &context.pou.body;
    // Labels that stand alone vanish: position i of the text becomes position[i] of the program.
    let mut position: Vec<usize> = Vec::with_capacity(body.len() + 1);
    let mut kept = 0;
    for instruction in body {
        position.push(kept);
        kept += usize::from(instruction.operation.is_some());
    }
    position.push(kept);
    let labels = control_flow::labels(body);
    let target = |name: &ast::Name| Some(position[*labels.get(&name.key())?]);
    let statements = body.iter().filter(|i| i.operation.is_some()).map(|i| statement(i, symbols, &target, kept));
    Some(Program {
        name: context.pou.name.text.clone(),
        variables: variables.collect::<Option<_>>()?,
        body: statements.collect::<Option<_>>()?,
    })
}

fn statement(
    instruction: &ast::Instruction,
    symbols: &Symbols<'_>,
    target: &dyn Fn(&ast::Name) -> Option<usize>,
    end: usize,
) -> Option<Statement> {
    let action = match instruction.operation.as_ref()? {
        Operation::Simple { operator, operands } => Action::Plain(simple(*operator, operands.first(), symbols)?),
        Operation::Parenthesis { operator, first, body, close } => Action::Defer {
            function: function(operator.verb)?,
            negated: operator.negated,
            first: match first {
                Some(first) => Some((operand(first, symbols)?, first.span())),
                None => None,
            },
            body: body.iter().map(|inner| statement(inner, symbols, target, end)).collect::<Option<_>>()?,
            close: *close,
        },
        Operation::Jump { condition, target: label } => {
            Action::Plain(Instruction::Jump { condition: *condition, target: target(label)? })
        }
        Operation::Return { condition } => Action::Plain(Instruction::Jump { condition: *condition, target: end }),
        Operation::Call { .. } | Operation::Function { .. } | Operation::Broken => return None,
    };
    Some(Statement { action, span: instruction.span })
}

fn simple(operator: Operator, given: Option<&ast::Operand>, symbols: &Symbols<'_>) -> Option<Instruction> {
    let negated = operator.negated;
    let variable = || match operand(given?, symbols)? {
        Operand::Variable(variable) => Some(variable),
        Operand::Constant(_) => None,
    };
    Some(match operator.verb {
        Verb::Ld => Instruction::Load { negated, operand: operand(given?, symbols)? },
        Verb::St => Instruction::Store { negated, variable: variable()? },
        Verb::S => Instruction::Set(variable()?),
        Verb::R => Instruction::Reset(variable()?),
        Verb::Not => Instruction::Complement,
        verb => Instruction::Combine { function: function(verb)?, negated, operand: operand(given?, symbols)? },
    })
}

fn function(verb: Verb) -> Option<Function> {
    match verb {
        Verb::And => Some(Function::And),
        Verb::Or => Some(Function::Or),
        Verb::Xor => Some(Function::Xor),
        _ => None,
    }
}

fn operand(operand: &ast::Operand, symbols: &Symbols<'_>) -> Option<Operand> {
    match operand {
        ast::Operand::Constant(constant) => constant.boolean.map(Operand::Constant),
        ast::Operand::Variable(name) => symbols.find(&name.text).map(|(id, _)| Operand::Variable(id)),
    }
}
