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
        let driven: Vec<VarId> =
            program.with_role(Role::Input).filter(|&id| system.plant.driver(id) == Some(i)).collect();
        let gives = match driven.len() {
            0 if component.transitions.is_empty() => continue,
            0 => String::new(),
            1 => format!("gives {} its value and ", names(driven)),
            _ => format!("gives {} their values and ", names(driven)),
        };
        let moves = match component.transitions.is_empty() {
            true => "never moves",
            false => "moves any number of times between two scans, or not at all",
        };
        assumptions.push(format!("`{}` {gives}{moves}", component.name));
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
