//! A trace of scans executed by the interpreter, with the plant's markings beside it.

use super::replay::Disagreement;
use super::scan_trace::{Holds, Scan, ScanTrace};
use crate::interpret::{Fault, Machine};
use crate::logic::Valuation;
use crate::net::{PlaceId, TransitionId};
use crate::semantics::VarId;
use crate::translate::System;

/// Executes the scans of a trace, and calls `at_end` at the end of each with its position. Hazards must be met where the
/// trace says, and end states be as it says.
///
/// # Errors
/// The trace is not one of the system, or `at_end` finds that it does not show what it should.
pub fn execute_scans(
    system: &System,
    trace: &ScanTrace,
    at_end: &mut dyn FnMut(usize, Holds<'_>) -> Result<(), Disagreement>,
) -> Result<(), Disagreement> {
    let mut machine = Machine::new(&system.program);
    let mut plant = vec![0; system.plant.components.len()];
    for (position, scan) in trace.scans.iter().enumerate() {
        let in_scan = |what: String| Disagreement(format!("in scan {}: {what}", position + 1));
        move_plant(system, scan, &mut plant, &machine).map_err(in_scan)?;
        for &(input, value) in &scan.inputs {
            if !can_be(system, &plant, input, value) {
                return Err(in_scan(format!("`{}` cannot have this value", system.program.variable(input).name)));
            }
            machine.set(input, value);
        }
        let ended = machine.scan();
        if scan.hazard.is_some_and(|hazard| !machine.hazards().contains(&hazard)) {
            return Err(in_scan("it does not meet this hazard".to_owned()));
        }
        match (&scan.end, ended) {
            (None, Err(Fault::Endless)) => return Ok(()),
            (None, Err(Fault::TooLong)) if scan.hazard.is_some() => return Ok(()),
            (None, _) => return Err(in_scan("it ends".to_owned())),
            (Some(_), Err(_)) => return Err(in_scan("it never ends".to_owned())),
            (Some(end), Ok(())) => {
                let other = system.program.declared().find(|&id| machine.value(id) != end.memory[id.0]);
                if let Some(id) = other {
                    let name = &system.program.variable(id).name;
                    return Err(in_scan(format!("the search has another value of `{name}` at its end")));
                }
                if end.plant != plant {
                    return Err(in_scan("the search has another marking of the plant at its end".to_owned()));
                }
                let shown = at_end(position, &|formula| formula.holds_in(&Executed(&machine)));
                shown.map_err(|Disagreement(what)| in_scan(what))?;
            }
        }
    }
    Ok(())
}

/// Makes the plant's moves before a scan.
fn move_plant(system: &System, scan: &Scan, plant: &mut [usize], machine: &Machine<'_>) -> Result<(), String> {
    for step in &scan.moves {
        let component = &system.plant.components[step.component];
        let marking = &component.markings[plant[step.component]];
        let transition = &component.transitions[step.transition];
        let enabled = transition.tests.iter().all(|&(output, value)| machine.value(output) == value);
        match marking.moves.iter().find(|step_of| step_of.transition == step.transition) {
            Some(found) if enabled => plant[step.component] = found.target,
            _ => return Err(format!("`{}` is not enabled", transition.name)),
        }
    }
    Ok(())
}

/// Whether an input can have a value now.
fn can_be(system: &System, plant: &[usize], input: VarId, value: u64) -> bool {
    match system.plant.driver(input) {
        Some(driver) => system.plant.components[driver].markings[plant[driver]].inputs.contains(&(input, value)),
        None => {
            let domain = system.domain(input);
            domain.contains(domain.ty.number(value))
        }
    }
}

/// What a machine at the end of a scan says of variables. There are no places.
struct Executed<'a>(&'a Machine<'a>);

impl Valuation for Executed<'_> {
    fn value(&self, variable: VarId) -> u64 {
        self.0.value(variable)
    }

    fn is_marked(&self, _: PlaceId) -> bool {
        false
    }

    fn is_enabled(&self, _: TransitionId) -> bool {
        false
    }
}
