//! Assertions at lines: every scan of a graph is run by the interpreter and checked whenever control reaches a line.

use rayon::prelude::*;

use super::coverage::starts;
use super::scan_space::ScanSpace;
use petril_lang::interpret::Machine;
use petril_lang::semantics::{Role, VarId};
use petril_search::Graph;
use petril_search::StateSpace;

/// A scan in which an assertion fails.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seen {
    /// State before the scan; `None` is power-on.
    pub from: Option<u32>,
    /// Marking of each plant component during the scan.
    pub plant: Vec<usize>,
    /// Values of the inputs in the scan.
    pub inputs: Vec<(VarId, u64)>,
    /// Position of the line in the list of watched lines.
    pub watched: usize,
}

/// Number of states per thread in a batch.
const TOGETHER: usize = 64;

/// Predicate for a failing assertion: position of the watched line, values of the variables before the scan, current
/// values.
type IsWrong<'a> = &'a (dyn Fn(usize, &dyn Fn(VarId) -> u64, &dyn Fn(VarId) -> u64) -> bool + Sync);

/// Runs every scan of a graph, and calls `is_wrong` whenever control reaches a watched line. Returns for each watched
/// line the nearest scan in which it was true; `None` if `stopped` becomes true meanwhile, or no scan can be run.
#[must_use]
pub fn first_at_lines(
    space: &ScanSpace<'_>,
    graph: &Graph,
    lines: &[usize],
    is_wrong: IsWrong<'_>,
    stopped: &mut dyn FnMut() -> bool,
) -> Option<Vec<Option<Seen>>> {
    if space.refusal().is_some() {
        return None;
    }
    let mut found: Vec<Option<Seen>> = vec![None; lines.len()];
    let mut at: Vec<Vec<usize>> = vec![Vec::new(); space.system().program.end() + 1];
    lines.iter().enumerate().for_each(|(watched, &line)| at[line].push(watched));
    for states in starts(graph).chunks(TOGETHER * rayon::current_num_threads()) {
        if stopped() {
            return None;
        }
        let one = |from: &Option<u32>| Runner { space, graph, at: &at, is_wrong }.scans(*from);
        let seen: Vec<Vec<Seen>> = states.par_iter().map(one).collect();
        for seen in seen.into_iter().flatten() {
            found[seen.watched].get_or_insert(seen);
        }
        if found.iter().all(Option::is_some) {
            break;
        }
    }
    Some(found)
}

struct Runner<'a, 's> {
    space: &'a ScanSpace<'s>,
    graph: &'a Graph,
    /// Watched lines, by line of the program.
    at: &'a [Vec<usize>],
    is_wrong: IsWrong<'a>,
}

impl Runner<'_, '_> {
    /// Failures in the scans from a state, at most one for each watched line.
    fn scans(&self, from: Option<u32>) -> Vec<Seen> {
        let before = self.space.state(from, self.graph);
        let mut found: Vec<Seen> = Vec::new();
        self.space.beginnings(&before, &mut |machine, plant| {
            let program = &self.space.system().program;
            let inputs: Vec<(VarId, u64)> =
                program.with_role(Role::Input).map(|input| (input, machine.value(input))).collect();
            self.scan(machine, &before.memory, &mut |watched| {
                if found.iter().all(|seen| seen.watched != watched) {
                    found.push(Seen { from, plant: plant.to_vec(), inputs: inputs.clone(), watched });
                }
            });
        });
        found
    }

    /// Runs one scan to its end, or until it repeats a state.
    fn scan(&self, machine: &mut Machine<'_>, before: &[u64], wrong: &mut dyn FnMut(usize)) {
        machine.begin_scan();
        // Endless scans are found by Brent's algorithm: a state kept twice as long each time is met again.
        let (mut kept, mut steps, mut limit) = (machine.clone(), 0_usize, 64_usize);
        loop {
            for &watched in &self.at[machine.line()] {
                if (self.is_wrong)(watched, &|id| before[id.0], &|id| machine.value(id)) {
                    wrong(watched);
                }
            }
            if machine.at_end() {
                return;
            }
            machine.step();
            steps += 1;
            if machine.same_state(&kept) {
                return;
            }
            if steps == limit {
                (kept, steps, limit) = (machine.clone(), 0, limit * 2);
            }
        }
    }
}
