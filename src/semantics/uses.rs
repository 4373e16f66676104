//! Which variables an instruction names, and for what.

use super::Context;
use super::effect::block;
use crate::syntax::ast::{
    Argument, Arguments, Feed, Instruction, Operand, Operation, Part, Path, Subscript, Verb, with_nested,
};

/// Every path in a unit, and whether it is written.
pub fn paths<'a>(context: &Context<'a>) -> Vec<(&'a Path, bool)> {
    let mut paths = Vec::new();
    for (instruction, _) in with_nested(&context.pou.body) {
        of_instruction(instruction, context, &mut paths);
    }
    let indices: Vec<(&Path, bool)> = paths.iter().flat_map(|(path, _)| indices(path)).collect();
    paths.extend(indices);
    paths
}

fn of_instruction<'a>(instruction: &'a Instruction, context: &Context<'a>, paths: &mut Vec<(&'a Path, bool)>) {
    match &instruction.operation {
        Some(Operation::Simple { operator, operands }) => {
            let writes = matches!(operator.verb, Verb::St | Verb::S | Verb::R)
                && operands.first().is_some_and(|operand| block(operand, context).is_none());
            operands.iter().for_each(|operand| of_operand(operand, writes, paths));
        }
        Some(Operation::Parenthesis { first: Some(first), .. }) => of_operand(first, false, paths),
        Some(Operation::Call { callee, arguments, .. }) => {
            paths.push((callee, false));
            of_arguments(arguments, context, paths);
        }
        Some(Operation::Function { arguments, .. }) => of_arguments(arguments, context, paths),
        _ => {}
    }
}

fn of_arguments<'a>(arguments: &'a Arguments, context: &Context<'a>, paths: &mut Vec<(&'a Path, bool)>) {
    for argument in &arguments.list {
        match argument {
            Argument::Positional(operand) | Argument::Input { value: Feed::Operand(operand), .. } => {
                of_operand(operand, false, paths);
            }
            Argument::Input { value: Feed::List(list), .. } => {
                list.iter().for_each(|instruction| of_instruction(instruction, context, paths));
            }
            Argument::Output { target, .. } => of_operand(target, true, paths),
        }
    }
}

fn of_operand<'a>(operand: &'a Operand, writes: bool, paths: &mut Vec<(&'a Path, bool)>) {
    if let Operand::Variable(path) = operand {
        paths.push((path, writes));
    }
}

/// The variables that choose elements.
fn indices(path: &Path) -> Vec<(&Path, bool)> {
    let subscripts = path.parts.iter().flat_map(|part| match part {
        Part::Index(subscripts, _) => subscripts.as_slice(),
        Part::Member(_) => &[],
    });
    let variables = subscripts.filter_map(|subscript| match subscript {
        Subscript::Variable(path) => Some((path, false)),
        Subscript::Constant(_) => None,
    });
    variables.collect()
}
