//! Validation of cached outcomes: runs are replayed before anybody sees them.

use crate::translate::System;
use crate::verdict::{Outcome, Remark, Trace, Why, Witness};
use crate::witness::{FiringTrace, Holds, ScanTrace, replay_firings, replay_scans};
use petril_lang::semantics::VarId;
use petril_logic::{Bound, Dag, Node, along};

/// Whether everything an outcome mentions exists, its runs are runs of the system, and a counterexample violates the
/// formula.
pub fn is_confirmed(system: &System, formula: Option<&Bound>, outcome: &Outcome) -> bool {
    match outcome {
        Outcome::Unknown(_) => true,
        Outcome::Holds { witness, example, .. } => {
            witness.iter().chain(example).all(|witness| replay(system, witness, &mut |_, _| ()))
        }
        Outcome::Violated(witness, why) => {
            why.iter().all(|why| exists(system, why, witness)) && breaks(system, formula, witness)
        }
    }
}

/// Whether the variable or line of a remark exists.
pub fn is_about(system: &System, remark: &Remark) -> bool {
    match *remark {
        Remark::NeverChanges(variable, _) => has(system, variable),
        Remark::NeverExecuted(line) => line < system.program.end(),
    }
}

fn has(system: &System, variable: VarId) -> bool {
    variable.0 < system.program.variables.len()
}

/// Replays a run and hands the valuation at each position to `at`.
fn replay(system: &System, witness: &Witness, at: &mut dyn FnMut(usize, Holds<'_>)) -> bool {
    let length = length(&witness.trace);
    if length == 0 || witness.notes.iter().any(|note| note.first > note.last || note.last >= length) {
        return false;
    }
    let replayed = match &witness.trace {
        Trace::Scans(trace) if fits(system, trace) => replay_scans(system, trace, |position, recalled| {
            at(position, &|formula| recalled.holds(formula));
            Ok(())
        }),
        Trace::Firings(trace) if is_of(system, trace) => replay_firings(system, trace, |position, replay| {
            at(position, &|formula| replay.holds(formula));
            Ok(())
        }),
        _ => return false,
    };
    replayed.is_ok()
}

/// Number of states of a run; a loop's last state repeats the one where it begins, and is counted.
fn length(trace: &Trace) -> usize {
    match trace {
        Trace::Scans(trace) => trace.scans.len(),
        Trace::Firings(trace) => trace.firings.len() + 1,
    }
}

/// Whether a run mentions only what the system has. Values are left to the replay.
fn fits(system: &System, trace: &ScanTrace) -> bool {
    let (program, plant) = (&system.program, &system.plant);
    trace.scans.iter().all(|scan| {
        let end = scan.end.as_ref().is_none_or(|end| {
            let markings = plant.components.iter().map(|component| component.markings.len());
            end.memory.len() == program.variables.len()
                && end.plant.len() == plant.components.len()
                && end.plant.iter().zip(markings).all(|(&marking, all)| marking < all)
        });
        end && scan.inputs.iter().all(|&(input, _)| has(system, input))
            && scan.hazard.is_none_or(|(line, _)| line < program.end())
    })
}

fn is_of(system: &System, trace: &FiringTrace) -> bool {
    let transitions = system.net.transition_ids();
    trace.firings.iter().all(|fired| fired.index() < transitions.len())
        && trace.loop_start.is_none_or(|start| start < trace.firings.len())
}

fn exists(system: &System, why: &Why, witness: &Witness) -> bool {
    let length = length(&witness.trace);
    let changes = why.repair.iter().flat_map(|repair| repair.changes.iter().chain(repair.others.iter().flatten()));
    why.writers.iter().all(|w| has(system, w.variable) && w.scan < length && w.line < system.program.end())
        && why.unwritten.iter().all(|&variable| has(system, variable))
        && changes.into_iter().all(|change| has(system, change.input) && change.scan < length)
}

/// Whether a run replays and violates the formula as far as one run can show it: claims about all runs from one of its
/// states are not checked.
fn breaks(system: &System, formula: Option<&Bound>, witness: &Witness) -> bool {
    let mut dag = Dag::default();
    let broken = formula.filter(|formula| !matches!(formula, Bound::Ltl(_))).map(|formula| dag.add(formula, true));
    let atoms: Vec<&Bound> = match formula {
        Some(Bound::Ltl(path)) => path.atoms(),
        _ => dag.nodes().iter().filter_map(Node::state).collect(),
    };
    let mut held: Vec<Vec<Option<bool>>> = Vec::new();
    if !replay(system, witness, &mut |_, holds| held.push(atoms.iter().map(|atom| holds(atom)).collect())) {
        return false;
    }
    let Some(formula) = formula else { return true };
    let loop_start = match &witness.trace {
        Trace::Scans(trace) => trace.loop_start,
        Trace::Firings(trace) => trace.loop_start,
    };
    // The last state of a loop repeats the one where it begins.
    let length = held.len() - usize::from(loop_start.is_some());
    if held.iter().flatten().any(Option::is_none) || length == 0 {
        return false;
    }
    let at = |atom: usize, position: usize| held[position][atom] == Some(true);
    match (formula, broken) {
        (Bound::Ltl(path), _) => {
            let mut next = 0..;
            let numbered = path.map(&mut |_| next.next().unwrap_or_default());
            !numbered.holds_on(length, loop_start, &|&atom: &usize, position| at(atom, position))
        }
        (_, Some(broken)) => {
            let number = |formula: &Bound| atoms.iter().position(|&atom| std::ptr::eq(atom, formula));
            let holds = |formula: &Bound, position: usize| number(formula).is_some_and(|atom| at(atom, position));
            along(&dag, (length, loop_start), &holds, &|_, _| true)[broken.index()][0]
        }
        (_, None) => false,
    }
}
