//! Differential test of gates against the interpreter on random scans.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::subject::Subject;
use petril_lang::circuit::ScanGates;
use petril_lang::interpret::Machine;
use petril_lang::semantics::{Role, VarId};

/// Number of runs computed in parallel.
const RUNS: usize = 64;

/// Number of scans of each run.
const SCANS: usize = 16;

/// Returns the number of scans compared, or the first difference.
pub(super) fn compare(subject: &Subject<'_>, gates: &ScanGates) -> Result<usize, String> {
    let program = subject.program;
    let mut chance = ChaCha8Rng::seed_from_u64(0);
    let mut machines = vec![Machine::new(program); RUNS];
    for _ in 0..SCANS {
        for input in program.with_role(Role::Input) {
            let ty = program.variable(input).ty;
            let (least, greatest) = program.range(input);
            for machine in &mut machines {
                let count = (greatest - least) as u128 + 1;
                let number = least + ((u128::from(chance.next_u64()) * count) >> 64) as i128;
                machine.set(input, ty.pattern(number));
            }
        }
        let word = |&(variable, bit): &(VarId, u32)| {
            machines
                .iter()
                .enumerate()
                .fold(0, |word, (run, machine)| word | (machine.value(variable) >> bit & 1) << run)
        };
        let inputs: Vec<u64> = gates.inputs.iter().map(word).collect();
        let lanes = gates.evaluate(&inputs);
        for (run, machine) in machines.iter_mut().enumerate() {
            let ended = machine.scan();
            let error = subject.tolerated.first_error(machine.hazards());
            let met = gates.errors.iter().find(|(wire, ..)| lanes.word(*wire) >> run & 1 == 1);
            if met.map(|&(_, line, hazard)| (line, hazard)) != error || error.is_none() && ended.is_err() {
                return Err("gates and interpreter disagree about an error".to_owned());
            }
            if error.is_some() {
                *machine = Machine::new(program);
                continue;
            }
            let differs = program.declared().find(|id| lanes.pattern(&gates.end[id.0], run) != machine.value(*id));
            if let Some(differs) = differs {
                return Err(format!("gates and interpreter disagree about `{}`", program.variable(differs).name));
            }
        }
    }
    Ok(RUNS * SCANS)
}
