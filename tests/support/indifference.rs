//! What flat code says makes no difference, tried: values that a scan does not carry on, and values of an input that no
//! comparison tells apart.

use petril::flat::{FlatProgram, Hazard};
use petril::interpret::Machine;
use petril::semantics::{Role, VarId};
use proptest::prelude::*;

use super::agreement::Inputs;
use super::random_flat::Choices;

/// Executes the scans twice, the second time with such values changed, and compares everything else.
pub fn indifferent(program: &FlatProgram, scans: &[Inputs], choices: &mut Choices<'_>) -> Result<(), TestCaseError> {
    let carried = program.carried();
    let is_given = |id: VarId| matches!(program.variable(id).role, Role::Input | Role::Constant);
    let idle = |&id: &VarId| !is_given(id) && !carried.contains(id.0) && !program.restrictions.contains_key(&id);
    let idle: Vec<VarId> = program.declared().filter(idle).collect();
    let (mut machine, mut other) = (Machine::new(program), Machine::new(program));
    for scan in scans {
        for &(input, value) in scan {
            machine.set(input, value);
            other.set(input, alike(program, input, value));
        }
        for &id in &idle {
            let variable = program.variable(id);
            other.set(id, choices.pattern(variable.ty) & (u64::MAX >> (64 - variable.bits)));
        }
        let ended = [machine.scan().is_ok(), other.scan().is_ok()];
        prop_assert_eq!(ended, [true, true]);
        let hazards =
            |machine: &Machine<'_>| machine.hazards().iter().map(|&(_, hazard)| hazard).collect::<Vec<Hazard>>();
        prop_assert_eq!(hazards(&machine), hazards(&other));
        for id in program.declared().filter(|&id| program.variable(id).role != Role::Input) {
            let name = &program.variable(id).name;
            prop_assert_eq!(machine.value(id), other.value(id), "{} with {:?} changed", name, idle);
        }
    }
    Ok(())
}

/// The next number, if the program cannot tell the two apart.
fn alike(program: &FlatProgram, input: VarId, value: u64) -> u64 {
    let ty = program.variable(input).ty;
    let number = ty.number(value);
    let is_told_apart = program.compared(input).is_none_or(|cuts| cuts.contains(&number));
    if is_told_apart || number == program.range(input).1 { value } else { ty.pattern(number + 1) }
}
