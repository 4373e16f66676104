//! Coverage: lines modelled and executed, variables read, written and mentioned.

use std::collections::BTreeSet;

use crate::translate::System;
use petril_lang::flat::{FlatProgram, Target};
use petril_lang::semantics::{Role, VarId};
use petril_logic::Bound;

/// Coverage of a program. All lines are modelled: a program with others is rejected before.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Coverage {
    /// Number of lines of flat code.
    pub lines: usize,
    /// Lines that no reachable scan executes, from 0, ascending; `None` if not known.
    pub never_executed: Option<Vec<usize>>,
    /// Inputs that no instruction reads.
    pub never_read: Vec<VarId>,
    /// Outputs that no instruction writes.
    pub never_written: Vec<VarId>,
    /// Outputs that no requirement mentions. (A requirement may still depend on them.)
    pub unasked: Vec<VarId>,
}

/// Computes the coverage of a system by requirements.
pub fn coverage<'f>(
    system: &System,
    formulas: impl Iterator<Item = &'f Bound>,
    never_executed: Option<Vec<usize>>,
) -> Coverage {
    let program = &system.program;
    let asked: BTreeSet<VarId> = formulas.flat_map(|formula| formula.mentions().variables).collect();
    let (read, written) = (read(program), written(program));
    let without = |role, set: &BTreeSet<VarId>| program.with_role(role).filter(|id| !set.contains(id)).collect();
    Coverage {
        lines: program.end(),
        never_executed,
        never_read: without(Role::Input, &read),
        never_written: without(Role::Output, &written),
        unasked: without(Role::Output, &asked),
    }
}

/// Variables that some instruction reads.
pub fn read(program: &FlatProgram) -> BTreeSet<VarId> {
    let chosen = program.code.iter().filter_map(|code| code.instruction.writes());
    let indices = chosen.filter_map(|target| match target {
        Target::Element(element) => Some(element.index),
        Target::Variable(_) => None,
    });
    let read = program.code.iter().filter_map(|code| code.instruction.reads());
    let read = read.flat_map(|target| match target {
        Target::Element(element) => element.all().chain([element.index]).collect::<Vec<_>>(),
        Target::Variable(variable) => vec![variable],
    });
    read.chain(indices).collect()
}

/// Variables that some instruction writes.
fn written(program: &FlatProgram) -> BTreeSet<VarId> {
    let written = program.code.iter().filter_map(|code| code.instruction.writes());
    let all = written.flat_map(|target| match target {
        Target::Element(element) => element.all().collect::<Vec<_>>(),
        Target::Variable(variable) => vec![variable],
    });
    all.collect()
}
