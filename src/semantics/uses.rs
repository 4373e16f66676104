//! Which variables an instruction names, and for what.

use super::effect::{block, shape};
use super::symbols::Symbols;
use super::{Context, PouId, Section, Shape};
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

/// Every path in a list, before anything is known of the names.
pub fn named(body: &[Instruction]) -> Vec<&Path> {
    let mut paths = Vec::new();
    for (instruction, _) in with_nested(body) {
        of_any(instruction, &mut paths);
    }
    let indices: Vec<&Path> = paths.iter().flat_map(|path| indices(path)).map(|(path, _)| path).collect();
    paths.extend(indices);
    paths
}

fn of_any<'a>(instruction: &'a Instruction, paths: &mut Vec<&'a Path>) {
    let mut operand = |operand: &'a Operand| {
        if let Operand::Variable(path) = operand {
            paths.push(path);
        }
    };
    let arguments = match &instruction.operation {
        Some(Operation::Simple { operands, .. }) => return operands.iter().for_each(operand),
        Some(Operation::Parenthesis { first, .. }) => return first.iter().for_each(operand),
        Some(Operation::Call { arguments, .. } | Operation::Function { arguments, .. }) => &arguments.list,
        _ => return,
    };
    for argument in arguments {
        match argument {
            Argument::Positional(value) | Argument::Input { value: Feed::Operand(value), .. } => operand(value),
            Argument::Output { target, .. } => operand(target),
            Argument::Input { value: Feed::List(_), .. } => {}
        }
    }
    for argument in arguments {
        if let Argument::Input { value: Feed::List(list), .. } = argument {
            list.iter().for_each(|instruction| of_any(instruction, paths));
        }
    }
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
            let id = match shape(callee, context) {
                Some(Shape::Instance(id)) => Some(id),
                _ => None,
            };
            of_arguments(arguments, id, context, paths);
        }
        Some(Operation::Function { name, arguments }) => {
            of_arguments(arguments, context.project.find(&name.text), context, paths);
        }
        _ => {}
    }
}

/// The arguments of a call. A variable that an in-out variable stands for is read, and it is written: by what is called.
fn of_arguments<'a>(
    arguments: &'a Arguments,
    callee: Option<PouId>,
    context: &Context<'a>,
    paths: &mut Vec<(&'a Path, bool)>,
) {
    let symbols = callee.map(|id| context.project.symbols(id));
    let section = |name: &str| symbols.and_then(|symbols| symbols.find(name)).map(|(_, symbol)| symbol.section);
    let by_position = symbols.into_iter().flat_map(Symbols::list).map(|symbol| symbol.section);
    let by_position = by_position.filter(|section| matches!(section, Section::Input | Section::InOut));
    // Behind the name of a function alone, the first input is the current result.
    let mut by_position = by_position.skip(usize::from(!arguments.enclosed));
    for argument in &arguments.list {
        let section = match argument {
            Argument::Positional(_) => by_position.next(),
            Argument::Input { name, .. } | Argument::Output { name, .. } => section(&name.text),
        };
        match argument {
            Argument::Positional(operand) | Argument::Input { value: Feed::Operand(operand), .. } => {
                of_operand(operand, false, paths);
                if section == Some(Section::InOut) {
                    of_operand(operand, true, paths);
                }
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
