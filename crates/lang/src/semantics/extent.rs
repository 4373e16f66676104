//! Size of a program when all its calls are inlined. Two calls in each of thirty units are a thousand million.

use std::collections::BTreeMap;

use super::effect::shape;
use super::project::Project;
use super::shape::{PouId, Shape, elements};
use super::symbols::Section;
use crate::syntax::ast::{Operand, Operation, PouKind, with_nested};
use petril_base::diagnostic::{Code, Diagnostic};

/// Maximum number of instructions, and of values, of a program.
const MAX: usize = 1 << 20;

/// Number of instructions and of elementary values of a unit with all it calls.
type Extent = (usize, usize);

/// Reports a program that is too large. `needed` are its units, callees before callers.
pub fn check(project: &Project<'_>, needed: &[PouId], found: &mut Vec<Diagnostic>) {
    let mut known = BTreeMap::new();
    for &id in needed {
        let extent = (instructions(project, id, &known), values(project, id, &known));
        known.insert(id, extent);
        let (what, count) = match extent {
            (instructions, _) if instructions > MAX => ("instructions", instructions),
            (_, values) if values > MAX => ("values", values),
            _ => continue,
        };
        let pou = project.pou(id);
        let count = if count == usize::MAX { "very many".to_owned() } else { count.to_string() };
        let message = format!("`{}` has {count} {what} when all its calls are written out", pou.name.text);
        let help = format!("every call becomes a part of the net of its own; a program may have {MAX} {what}");
        found.push(Diagnostic::new(Code::ProgramTooLarge, pou.name.span, message).help(help));
        return;
    }
    // Functions have one set of variables for all their calls.
    let sets = needed
        .iter()
        .enumerate()
        .filter(|&(i, &id)| i + 1 == needed.len() || project.pou(id).kind == PouKind::Function);
    let shapes = project.globals.list().iter().filter_map(|symbol| symbol.shape.as_ref());
    let values = sets.map(|(_, id)| known.get(id).map_or(0, |(_, values)| *values));
    let values = values.chain(shapes.map(|shape| of_shape(shape, &known))).fold(0, usize::saturating_add);
    if let (Some(&entry), true) = (needed.last(), values > MAX) {
        let pou = project.pou(entry);
        let message = format!("`{}` has {values} values with its functions and global variables", pou.name.text);
        let help = format!("every value becomes places of the net; a program may have {MAX} values");
        found.push(Diagnostic::new(Code::ProgramTooLarge, pou.name.span, message).help(help));
    }
}

fn instructions(project: &Project<'_>, id: PouId, known: &BTreeMap<PouId, Extent>) -> usize {
    let context = project.context(id);
    // Variables that are initialised at every call are given their values there.
    let begins_anew = |section| section == Section::Temp || context.pou.kind == PouKind::Function;
    let anew = context.symbols.list().iter().filter(|symbol| begins_anew(symbol.section));
    let mut sum = anew
        .filter_map(|symbol| symbol.shape.as_ref())
        .fold(0, |sum: usize, shape| sum.saturating_add(of_shape(shape, known)));
    for (instruction, _) in with_nested(&context.pou.body) {
        let instance = match &instruction.operation {
            Some(Operation::Call { callee, .. }) => Some(callee),
            Some(Operation::Simple { operator, operands }) if operator.verb.is_block_input() => {
                match operands.first() {
                    Some(Operand::Variable(path)) => Some(path),
                    _ => None,
                }
            }
            _ => None,
        };
        let callee = match (&instruction.operation, instance.and_then(|path| shape(path, &context))) {
            (_, Some(Shape::Instance(id))) => Some(id),
            (Some(Operation::Function { name, .. }), _) => project.find(&name.text),
            _ => None,
        };
        let written_out = callee.and_then(|callee| known.get(&callee)).map_or(0, |(instructions, _)| *instructions);
        sum = sum.saturating_add(1).saturating_add(written_out);
    }
    sum
}

fn values(project: &Project<'_>, id: PouId, known: &BTreeMap<PouId, Extent>) -> usize {
    let own = project.symbols(id).list().iter().filter(|symbol| !matches!(symbol.section, Section::External(_)));
    own.filter_map(|symbol| symbol.shape.as_ref()).fold(0, |sum, shape| sum.saturating_add(of_shape(shape, known)))
}

fn of_shape(shape: &Shape, known: &BTreeMap<PouId, Extent>) -> usize {
    match shape {
        Shape::Scalar(_) => 1,
        Shape::Array { ranges, of } => elements(ranges).saturating_mul(of_shape(of, known)),
        Shape::Structure(structure) => {
            structure.members.iter().fold(0, |sum, member| sum.saturating_add(of_shape(&member.shape, known)))
        }
        Shape::Instance(id) => known.get(id).map_or(0, |(_, values)| *values),
    }
}
