//! Plans, and the execution of a scan by its plan.

use std::fmt;

use crate::scans::{Failure, ScanState};
use crate::translate::System;
use crate::witness::{PlantMove, Scan};
use petril_lang::flat::Tolerated;
use petril_lang::interpret::Machine;
use petril_lang::semantics::{Role, VarId};

/// Plan of a scan: plant moves and input changes before it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// Moves of the plant.
    pub moves: Vec<PlantMove>,
    /// Free inputs with new values, as bit patterns of their types. Other inputs keep theirs.
    pub inputs: Vec<(VarId, u64)>,
}

/// Planned move that the plant cannot make: the name of the transition that is not enabled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Impossible(pub String);

impl fmt::Display for Impossible {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the plant cannot do `{}` now", self.0)
    }
}

/// Executes the scan from a state; returns its failure, too.
///
/// After an error, the rest of the scan, if it ends, is computed as if the hazard were tolerated.
///
/// # Errors
/// The plant cannot make a planned move.
pub fn scan(
    system: &System,
    tolerated: Tolerated,
    from: &ScanState,
    plan: &Plan,
) -> Result<(Scan, Option<Failure>), Impossible> {
    let plant = moved(system, from, &plan.moves)?;
    let inputs = inputs(system, from, &plant, plan);
    let mut machine = Machine::new(&system.program);
    machine.restore(&from.memory);
    inputs.iter().for_each(|&(input, value)| machine.set(input, value));
    let ended = machine.scan();
    let hazard = tolerated.first_error(machine.hazards());
    let failure = match (hazard, ended) {
        (Some((line, hazard)), _) => Some(Failure::Hazard(line, hazard)),
        (None, Err(fault)) => Some(Failure::Scan(fault)),
        (None, Ok(())) => None,
    };
    let memory = || (0..system.program.variables.len()).map(|id| machine.value(VarId(id))).collect();
    let end = ended.ok().map(|()| ScanState { plant, memory: memory() });
    Ok((Scan { moves: plan.moves.clone(), inputs, end, hazard }, failure))
}

/// Markings of the plant after some moves from a state.
pub(super) fn moved(system: &System, from: &ScanState, moves: &[PlantMove]) -> Result<Vec<usize>, Impossible> {
    let mut plant = from.plant.clone();
    for &chosen in moves {
        let found = enabled(system, from, &plant, chosen.component).find(|&(other, _)| other == chosen);
        let (_, target) = found.ok_or_else(|| Impossible(chosen.name(system).to_owned()))?;
        plant[chosen.component] = target;
    }
    Ok(plant)
}

/// Moves that a component can make between two scans, in some markings of the plant, each with the marking it leads to.
/// Outputs are those of the scan before.
pub(super) fn enabled<'a>(
    system: &'a System,
    from: &'a ScanState,
    plant: &[usize],
    component: usize,
) -> impl Iterator<Item = (PlantMove, usize)> + 'a {
    let own = &system.plant.components[component];
    let moves = own.markings[plant[component]].moves.iter();
    moves
        .filter(|step| own.transitions[step.transition].tests.iter().all(|&(id, value)| from.memory[id.0] == value))
        .map(move |step| (PlantMove { component, transition: step.transition }, step.target))
}

/// Values of all inputs: driven by the plant, set by the plan, or unchanged.
pub(super) fn inputs(system: &System, from: &ScanState, plant: &[usize], plan: &Plan) -> Vec<(VarId, u64)> {
    let mut memory = from.memory.clone();
    // The initial value may lie outside the domain.
    for (&input, domain) in &system.domains {
        if !domain.contains(domain.ty.number(memory[input.0])) {
            memory[input.0] = domain.ty.pattern(domain.ranges()[0].0);
        }
    }
    plan.inputs.iter().for_each(|&(input, value)| memory[input.0] = value);
    for (component, &marking) in system.plant.components.iter().zip(plant) {
        component.markings[marking].inputs.iter().for_each(|&(input, value)| memory[input.0] = value);
    }
    system.program.with_role(Role::Input).map(|input| (input, memory[input.0])).collect()
}
