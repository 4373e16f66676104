//! What is done before a scan, and the scan it makes.

use std::fmt;

use crate::explore::{Failure, ScanState};
use crate::translate::System;
use crate::witness::{PlantMove, Scan};
use petril_lang::flat::Tolerated;
use petril_lang::interpret::Machine;
use petril_lang::semantics::{Role, VarId};

/// What is done before a scan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// What the plant does.
    pub moves: Vec<PlantMove>,
    /// Free inputs that get another value, as patterns. The others keep theirs.
    pub inputs: Vec<(VarId, u64)>,
}

/// The plant cannot do what a plan says: the name of the transition that is not enabled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Impossible(pub String);

impl fmt::Display for Impossible {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the plant cannot do `{}` now", self.0)
    }
}

/// The scan from a state, and what went wrong in it.
///
/// After a failure the end of the scan, if it has one, is as if the hazard were tolerated.
///
/// # Errors
/// The plant cannot do what the plan says.
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

/// The plant's markings after some moves from a state.
pub(super) fn moved(system: &System, from: &ScanState, moves: &[PlantMove]) -> Result<Vec<usize>, Impossible> {
    let mut plant = from.plant.clone();
    for &chosen in moves {
        let found = enabled(system, from, &plant, chosen.component).find(|&(other, _)| other == chosen);
        let (_, target) = found.ok_or_else(|| Impossible(chosen.name(system).to_owned()))?;
        plant[chosen.component] = target;
    }
    Ok(plant)
}

/// What a component can do between two scans, in some markings of the plant, and where it leads. The outputs are those of
/// the scan before.
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

/// The values that all inputs get: from the plant, from the plan, or those they had.
pub(super) fn inputs(system: &System, from: &ScanState, plant: &[usize], plan: &Plan) -> Vec<(VarId, u64)> {
    let mut memory = from.memory.clone();
    // A domain need not have the value of power-on.
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
