//! How large a program becomes when its calls are written out. What calls itself twice doubles with every level.

use std::collections::BTreeMap;

use super::program::{Action, Call, Callee, FeedSource, Program, Statement};
use super::shape::{PouId, Shape, elements};
use super::symbols::Section;

/// Lines and variables of flat code, at most.
const MAX_LINES: usize = 2_000_000;
const MAX_VARIABLES: usize = 500_000;

/// What is too large about a program, if anything is. `needed` has the units in such an order that each stands behind what it
/// calls.
pub fn too_large(program: &Program, needed: &[PouId]) -> Option<String> {
    let mut sizes: BTreeMap<PouId, (usize, usize)> = BTreeMap::new();
    for &id in needed {
        let pou = &program.pous[id.0];
        let lines = list(&pou.body, &sizes);
        let kept = pou.variables.iter().filter(|v| !matches!(v.section, Section::InOut | Section::External(_)));
        let variables = kept.fold(0_usize, |sum, variable| sum.saturating_add(leaves(&variable.shape, &sizes)));
        // Variables that begin anew are given their values at every call.
        let lines = lines.saturating_add(pou.variables.len() * 2);
        sizes.insert(id, (lines, variables));
    }
    let globals = program.globals.iter().fold(0_usize, |sum, global| sum.saturating_add(leaves(&global.shape, &sizes)));
    let (lines, variables) = sizes.get(&program.entry).copied().unwrap_or_default();
    if lines > MAX_LINES {
        Some(format!("more than {MAX_LINES} instructions"))
    } else if variables.saturating_add(globals) > MAX_VARIABLES {
        Some(format!("more than {MAX_VARIABLES} variables"))
    } else {
        None
    }
}

fn list(body: &[Statement], sizes: &BTreeMap<PouId, (usize, usize)>) -> usize {
    body.iter().fold(0, |sum: usize, statement| sum.saturating_add(lines(statement, sizes)))
}

fn lines(statement: &Statement, sizes: &BTreeMap<PouId, (usize, usize)>) -> usize {
    match &statement.action {
        Action::Defer { body, .. } => list(body, sizes).saturating_add(5),
        Action::Call(call) => self::call(call, sizes),
        Action::Standard(standard) => {
            let inner = standard.arguments.iter().map(|argument| source(&argument.source, sizes));
            inner.fold(10 * standard.arguments.len(), usize::saturating_add)
        }
        _ => 1,
    }
}

fn call(call: &Call, sizes: &BTreeMap<PouId, (usize, usize)>) -> usize {
    let (Callee::Instance(id, _) | Callee::Function(id)) = &call.callee;
    let own = sizes.get(id).map_or(0, |(lines, _)| *lines);
    let inputs = call.inputs.iter().map(|(_, feed)| source(&feed.source, sizes));
    inputs.fold(own.saturating_add(2 * call.outputs.len() + 4), usize::saturating_add)
}

fn source(source: &FeedSource, sizes: &BTreeMap<PouId, (usize, usize)>) -> usize {
    match source {
        FeedSource::List(body) => list(body, sizes).saturating_add(2),
        _ => 2,
    }
}

fn leaves(shape: &Shape, sizes: &BTreeMap<PouId, (usize, usize)>) -> usize {
    match shape {
        Shape::Scalar(_) => 1,
        Shape::Array { ranges, of } => elements(ranges).saturating_mul(leaves(of, sizes)),
        Shape::Structure(structure) => {
            structure.members.iter().fold(0, |sum, member| sum.saturating_add(leaves(&member.shape, sizes)))
        }
        Shape::Instance(id) => sizes.get(id).map_or(1, |(_, variables)| *variables),
    }
}
