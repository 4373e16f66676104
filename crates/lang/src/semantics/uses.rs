//! Variables that an instruction names, and whether it writes them.

use super::effect::{block, shape};
use super::symbols::Symbols;
use super::{Context, PouId, Section, Shape};
use crate::syntax::ast::{
    Argument, Arguments, Feed, Instruction, Operand, Operation, Part, Path, Subscript, Verb, with_nested,
};

/// Paths in a list, each with whether it is written. `context` is `None` before names are resolved.
pub fn paths<'a>(body: &'a [Instruction], context: Option<&Context<'_>>) -> Vec<(&'a Path, bool)> {
    let mut paths = Vec::new();
    for (instruction, _) in with_nested(body) {
        of_instruction(instruction, context, &mut paths);
    }
    let indices: Vec<(&Path, bool)> = paths.iter().flat_map(|(path, _)| indices(path)).collect();
    paths.extend(indices);
    paths
}

/// Paths in an instruction, but not those in the lists inside it.
fn of_instruction<'a>(instruction: &'a Instruction, context: Option<&Context<'_>>, paths: &mut Vec<(&'a Path, bool)>) {
    match &instruction.operation {
        Some(Operation::Simple { operator, operands }) => {
            let is_block = |operand| context.is_some_and(|context| block(operand, context).is_some());
            let writes =
                matches!(operator.verb, Verb::St | Verb::S | Verb::R) && !operands.first().is_some_and(is_block);
            operands.iter().for_each(|operand| of_operand(operand, writes, paths));
        }
        Some(Operation::Parenthesis { first: Some(first), .. }) => of_operand(first, false, paths),
        Some(Operation::Call { callee, arguments, .. }) => {
            paths.push((callee, false));
            let id = context.and_then(|context| match shape(callee, context)? {
                Shape::Instance(id) => Some(id),
                _ => None,
            });
            of_arguments(arguments, id.zip(context), paths);
        }
        Some(Operation::Function { name, arguments }) => {
            let callee = context.and_then(|context| Some((context.project.find(&name.text)?, context)));
            of_arguments(arguments, callee, paths);
        }
        _ => {}
    }
}

/// Paths in the arguments of a call. A variable bound to an in-out variable is read and written: by the called unit.
fn of_arguments<'a>(
    arguments: &'a Arguments,
    callee: Option<(PouId, &Context<'_>)>,
    paths: &mut Vec<(&'a Path, bool)>,
) {
    let symbols = callee.map(|(id, context)| context.project.symbols(id));
    let section = |name: &str| symbols.and_then(|symbols| symbols.find(name)).map(|(_, symbol)| symbol.section);
    let by_position = symbols.into_iter().flat_map(Symbols::list).map(|symbol| symbol.section);
    let by_position = by_position.filter(|section| matches!(section, Section::Input | Section::InOut));
    // After the name of a function without parentheses, the first input is the current result.
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
            Argument::Input { value: Feed::List(_), .. } => {}
            Argument::Output { target, .. } => of_operand(target, true, paths),
        }
    }
}

fn of_operand<'a>(operand: &'a Operand, writes: bool, paths: &mut Vec<(&'a Path, bool)>) {
    if let Operand::Variable(path) = operand {
        paths.push((path, writes));
    }
}

/// Variables that are indices of a path.
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
