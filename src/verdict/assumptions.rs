//! Under which assumptions the verdicts are proofs, in words.

use crate::semantics::{Role, VarId};
use crate::translate::System;

/// The assumptions about a system; `fair` says that only runs in which the PLC keeps scanning were considered.
pub fn assumptions(system: &System, fair: bool) -> Vec<String> {
    let program = &system.program;
    let names =
        |ids: Vec<VarId>| ids.iter().map(|&id| program.variable(id).name.as_str()).collect::<Vec<_>>().join(", ");
    let mut assumptions = vec!["the PLC starts cold: every variable has its initial value".to_owned()];
    for (i, component) in system.plant.components.iter().enumerate() {
        let driven = program.with_role(Role::Input).filter(|&id| system.plant.driver(id) == Some(i)).collect();
        let device = match names(driven) {
            driven if driven.is_empty() => format!("`{}`", component.name),
            driven => format!("`{}` gives {driven} their values and", component.name),
        };
        assumptions.push(format!("{device} moves any number of times between two scans, or not at all"));
    }
    let free = names(system.free_inputs().collect());
    if !free.is_empty() {
        assumptions.push(format!("{free} may have any value in any scan"));
    }
    if fair {
        assumptions.push("the PLC always scans again".to_owned());
    }
    assumptions
}
