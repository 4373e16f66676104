//! Further findings: outputs that never change, instructions that are never executed.

use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

use crate::scans::ScanSpace;
use petril_lang::flat::FlatProgram;
use petril_lang::semantics::{Role, VarId};
use petril_search::Graph;

/// Finding about all reachable states.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Remark {
    /// Output with its constant value at the end of every scan.
    NeverChanges(VarId, u64),
    /// Dead code: a line (from 0) that no scan executes, nor any other line of the same piece of source.
    NeverExecuted(usize),
}

/// Findings about a system, given its dead lines; none unless the graph is complete.
pub fn remarks(space: &ScanSpace<'_>, graph: &Graph, never: &[usize]) -> Vec<Remark> {
    if !graph.is_complete() || graph.is_empty() {
        return Vec::new();
    }
    let program = &space.system().program;
    let value = |id: u32, output| space.value(graph.state(id), output);
    let constant = |output: VarId| {
        let first = value(0, output);
        graph.ids().all(|id| value(id, output) == first).then_some(Remark::NeverChanges(output, first))
    };
    let mut remarks: Vec<Remark> = program.with_role(Role::Output).filter_map(constant).collect();
    remarks.extend(dead_pieces(program, never).into_iter().map(Remark::NeverExecuted));
    remarks
}

/// First dead line of each piece of source. All lines that come from one piece, such as the code of a function at each
/// call, must be dead.
pub fn dead_pieces(program: &FlatProgram, never: &[usize]) -> Vec<usize> {
    let mut spans: BTreeSet<_> = never.iter().map(|&line| program.code[line].span).collect();
    let is_dead: BTreeSet<usize> = never.iter().copied().collect();
    for (line, code) in program.code.iter().enumerate() {
        if !is_dead.contains(&line) {
            spans.remove(&code.span);
        }
    }
    let mut seen = BTreeSet::new();
    let is_first = |&line: &usize| {
        let span = program.code[line].span;
        spans.contains(&span) && seen.insert(span)
    };
    never.iter().copied().filter(is_first).collect()
}
