//! What of a program was modelled, executed, and asked about.

use std::collections::BTreeSet;

use crate::logic::Bound;
use crate::translate::System;
use petril_lang::flat::{FlatProgram, Target};
use petril_lang::semantics::{Role, VarId};

/// What of a program was modelled, executed, and asked about. All lines are modelled: what cannot be is an error before.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Coverage {
    /// How many lines of flat code there are.
    pub lines: usize,
    /// Those that no reachable scan executes, from 0, in their order; `None` if that is not known.
    pub never_executed: Option<Vec<usize>>,
    /// Inputs that no instruction reads.
    pub never_read: Vec<VarId>,
    /// Outputs that no instruction writes.
    pub never_written: Vec<VarId>,
    /// Outputs that no requirement speaks of. (One may still rest on them.)
    pub unasked: Vec<VarId>,
}

/// The coverage of a system by requirements.
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

/// The variables that some instruction reads.
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

/// The variables that some instruction writes.
fn written(program: &FlatProgram) -> BTreeSet<VarId> {
    let written = program.code.iter().filter_map(|code| code.instruction.writes());
    let all = written.flat_map(|target| match target {
        Target::Element(element) => element.all().collect::<Vec<_>>(),
        Target::Variable(variable) => vec![variable],
    });
    all.collect()
}
