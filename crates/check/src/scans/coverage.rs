//! Coverage: the lines of a program that are executed in some scan.

use std::collections::BTreeSet;

use fixedbitset::FixedBitSet;
use rayon::prelude::*;

use super::scan_space::{ScanSpace, ScanState};
use petril_lang::circuit::{Circuit, LANES, Scratch};
use petril_lang::flat::{Condition, FlatProgram, Instruction};
use petril_search::Graph;

/// Number of states tried one after another first: usually every line is covered soon.
const FIRST: usize = 256;

/// Number of states between two calls of `stop`.
const BATCH: usize = 256 * FIRST;

/// The lines, from 0, that control never reaches, whether no jump leads there or none of these jumps is ever taken. The
/// graph must be the complete one of the space. `stop` is called now and then; if it returns true, the result is
/// `None`.
pub fn never_executed(space: &ScanSpace<'_>, graph: &Graph, stop: &mut dyn FnMut() -> bool) -> Option<Vec<usize>> {
    let program = &space.system().program;
    let possible = possible_lines(program);
    let missing = |executed: &FixedBitSet| (0..program.end()).filter(|&line| !executed.contains(line)).collect();
    let has_choice = |line: usize| {
        let code = program.code.get(line).map(|code| code.instruction);
        matches!(code, Some(Instruction::Jump { condition, .. }) if condition != Condition::Always)
    };
    if !possible.ones().any(has_choice) {
        return Some(missing(&possible));
    }
    let starts = starts(graph);
    let mut executed = FixedBitSet::with_capacity(program.end() + 1);
    let (first, rest) = starts.split_at(starts.len().min(FIRST));
    for state in first {
        execute(space, &space.state(*state, graph), &mut executed);
        if possible.is_subset(&executed) {
            return Some(missing(&possible));
        }
    }
    let none = || FixedBitSet::with_capacity(program.end() + 1);
    let circuit = space.line_circuit();
    let piece = |states: &[Option<u32>]| {
        let mut executed = none();
        match &circuit {
            Some(circuit) => execute_together(space, circuit, graph, states, &mut executed),
            None => states.iter().for_each(|state| execute(space, &space.state(*state, graph), &mut executed)),
        }
        executed
    };
    for batch in rest.chunks(BATCH) {
        if stop() {
            return None;
        }
        executed.union_with(&batch.par_chunks(FIRST).map(piece).reduce(none, |a, b| &a | &b));
        if possible.is_subset(&executed) {
            break;
        }
    }
    Some(missing(&executed))
}

/// States whose scans represent all scans: power-on, which is `None`, and the first state of each row.
pub(super) fn starts(graph: &Graph) -> Vec<Option<u32>> {
    let mut rows = BTreeSet::new();
    let firsts = graph.ids().filter(|&id| graph.row_of(id).is_some_and(|row| rows.insert(row))).map(Some);
    std::iter::once(None).chain(firsts).collect()
}

/// Executes every scan from a state, and marks the lines executed.
fn execute(space: &ScanSpace<'_>, from: &ScanState, executed: &mut FixedBitSet) {
    space.beginnings(from, &mut |machine, _| {
        machine.begin_scan();
        while !machine.at_end() {
            executed.insert(machine.line());
            machine.step();
        }
        executed.insert(machine.line());
    });
}

/// Executes every scan from states of the graph by the circuit, and marks the lines executed.
fn execute_together(
    space: &ScanSpace<'_>,
    circuit: &Circuit,
    graph: &Graph,
    states: &[Option<u32>],
    executed: &mut FixedBitSet,
) {
    let (mut lanes, mut scratch) = (Vec::new(), Scratch::default());
    for &state in states.iter().flatten() {
        let state = graph.state(state);
        space.packed_beginnings(state, |begin| {
            lanes.extend_from_slice(begin);
            if lanes.len() == LANES * begin.len() {
                circuit.reach(&lanes, &mut scratch, executed);
                lanes.clear();
            }
        });
    }
    circuit.reach(&lanes, &mut scratch, executed);
}

/// The lines, and the end, that are reachable in the control-flow graph.
fn possible_lines(program: &FlatProgram) -> FixedBitSet {
    let mut possible = FixedBitSet::with_capacity(program.end() + 1);
    let mut work = vec![0];
    while let Some(line) = work.pop() {
        if possible.put(line) {
            continue;
        }
        match program.code.get(line).map(|code| code.instruction) {
            Some(Instruction::Jump { condition: Condition::Always, target }) => work.push(target),
            Some(Instruction::Jump { target, .. }) => work.extend([target, line + 1]),
            Some(_) => work.push(line + 1),
            None => {}
        }
    }
    possible
}
