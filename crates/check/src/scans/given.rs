//! A run of the scan view with given inputs, to answer what would have happened with other inputs.
//!
//! The inputs do not always determine the markings of the devices, so all that fit are kept. Devices move independently
//! of each other and depend only on outputs, so a list of markings for each device describes the possible runs exactly.

use super::scan_space::{ScanSpace, ScanState};
use petril_lang::interpret::Machine;
use petril_lang::semantics::{Role, VarId};

/// Position of a run with given inputs at the end of a scan, or at power-on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Position {
    /// Values of all variables; those of buffers are 0.
    pub memory: Vec<u64>,
    /// Possible markings of each device, ascending.
    pub plant: Vec<Vec<usize>>,
}

impl ScanSpace<'_> {
    /// Position at power-on.
    #[must_use]
    pub fn beginning(&self) -> Position {
        let ScanState { plant, memory } = self.power_on();
        Position { memory, plant: plant.into_iter().map(|marking| vec![marking]).collect() }
    }

    /// Runs the scan that reads these inputs, one value for each input of the program. `None` if the system has no such
    /// scan: a value is outside its domain, the plant cannot give it now, an assumption excludes it, or the scan ends
    /// in an error or does not end.
    #[must_use]
    pub fn scan_reading(&self, from: &Position, inputs: &[(VarId, u64)]) -> Option<Position> {
        let system = self.system();
        let allowed = |&(input, value): &(VarId, u64)| {
            let number = system.program.variable(input).ty.number(value);
            system.domains.get(&input).is_none_or(|domain| domain.contains(number))
        };
        if !inputs.iter().all(allowed) {
            return None;
        }
        let given = |input: VarId| inputs.iter().find(|(own, _)| *own == input).map(|&(_, value)| value);
        let mut plant = Vec::with_capacity(from.plant.len());
        for (component, markings) in system.plant.components.iter().zip(&from.plant) {
            let ahead = markings.iter().flat_map(|&marking| component.closure(marking, |output| from.memory[output.0]));
            let fits = |&marking: &usize| {
                let mut driven = component.markings[marking].inputs.iter();
                driven.all(|&(input, value)| given(input) == Some(value))
            };
            let mut fitting: Vec<usize> = ahead.map(|(marking, _)| marking).filter(fits).collect();
            fitting.sort_unstable();
            fitting.dedup();
            if fitting.is_empty() {
                return None;
            }
            plant.push(fitting);
        }
        let mut machine = Machine::new(&system.program);
        machine.restore(&from.memory);
        inputs.iter().for_each(|&(input, value)| machine.set(input, value));
        if !self.admits(&|id| from.memory[id.0], &|id| machine.value(id)) {
            return None;
        }
        self.scan(&mut machine).ok()?;
        let kept = |id: VarId| if system.program.variable(id).role == Role::Buffer { 0 } else { machine.value(id) };
        Some(Position { memory: (0..system.program.variables.len()).map(VarId).map(kept).collect(), plant })
    }

    /// Packed state with the memory of a position and some markings that fit.
    #[must_use]
    pub fn packed_position(&self, position: &Position) -> Vec<u64> {
        let plant: Vec<usize> = position.plant.iter().map(|fitting| fitting[0]).collect();
        self.packed(&plant, &position.memory)
    }

    /// Packed states of a run, from its first scan on, with markings that fit its inputs and follow each other.
    #[must_use]
    pub fn packed_run(&self, ends: &[Position]) -> Vec<Vec<u64>> {
        let mut later: Option<Vec<usize>> = None;
        let mut states: Vec<Vec<u64>> = Vec::with_capacity(ends.len());
        for end in ends.iter().rev() {
            // The last scan may end in any marking that fits, the others in one from which the next one can be reached.
            let leads_on =
                |component: usize, marking: usize| match (&later, self.system().plant.components.get(component)) {
                    (Some(later), Some(device)) => {
                        let closure = device.closure(marking, |output| end.memory[output.0]);
                        closure.iter().any(|&(reached, _)| reached == later[component])
                    }
                    _ => true,
                };
            let choice = end.plant.iter().enumerate().map(|(component, fitting)| {
                let fit = fitting.iter().copied().find(|&marking| leads_on(component, marking));
                fit.unwrap_or_else(|| fitting[0])
            });
            let plant: Vec<usize> = choice.collect();
            states.push(self.packed(&plant, &end.memory));
            later = Some(plant);
        }
        states.reverse();
        states
    }
}
