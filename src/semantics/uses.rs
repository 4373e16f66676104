//! Which variables an instruction names, and for what.

use super::effect::{block, shape};
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
            let block = match shape(callee, context) {
                Some(Shape::Instance(id)) => Some(id),
                _ => None,
            };
            of_arguments(arguments, block, context, paths);
        }
        Some(Operation::Function { name, arguments }) => {
            of_arguments(arguments, context.project.find(&name.text), context, paths);
        }
        _ => {}
    }
}

/// What is handed over to a unit. For an in-out variable it may be written there.
fn of_arguments<'a>(
    arguments: &'a Arguments,
    unit: Option<PouId>,
    context: &Context<'a>,
    paths: &mut Vec<(&'a Path, bool)>,
) {
    let symbols = unit.map(|id| context.project.symbols(id));
    let section = |name: &str| symbols.and_then(|symbols| Some(symbols.find(name)?.1.section));
    let mut in_order = symbols
        .into_iter()
        .flat_map(super::symbols::Symbols::list)
        .map(|symbol| symbol.section)
        .filter(|section| matches!(section, Section::Input | Section::InOut))
        .skip(usize::from(!arguments.enclosed));
    for argument in &arguments.list {
        match argument {
            Argument::Positional(operand) => of_operand(operand, in_order.next() == Some(Section::InOut), paths),
            Argument::Input { name, value: Feed::Operand(operand) } => {
                of_operand(operand, section(&name.text) == Some(Section::InOut), paths);
            }
            Argument::Input { value: Feed::List(list), .. } => {
                list.iter().for_each(|instruction| of_instruction(instruction, context, paths));
            }
            Argument::Output { target, .. } => of_operand(target, true, paths),
        }
    }
}

/// Every variable that a body names as an operand, whatever it is.
pub fn operands(body: &[Instruction]) -> Vec<&Path> {
    let mut paths = Vec::new();
    for (instruction, _) in with_nested(body) {
        match &instruction.operation {
            Some(Operation::Simple { operands, .. }) => operands.iter().for_each(|o| of_operand(o, false, &mut paths)),
            Some(Operation::Parenthesis { first: Some(first), .. }) => of_operand(first, false, &mut paths),
            Some(Operation::Call { arguments, .. } | Operation::Function { arguments, .. }) => {
                for argument in &arguments.list {
                    match argument {
                        Argument::Positional(operand)
                        | Argument::Input { value: Feed::Operand(operand), .. }
                        | Argument::Output { target: operand, .. } => of_operand(operand, false, &mut paths),
                        Argument::Input { value: Feed::List(list), .. } => {
                            paths.extend(operands(list).into_iter().map(|path| (path, false)));
                        }
                    }
                }
            }
            _ => {}
        }
    }
    let indices: Vec<(&Path, bool)> = paths.iter().flat_map(|(path, _)| indices(path)).collect();
    paths.into_iter().chain(indices).map(|(path, _)| path).collect()
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
