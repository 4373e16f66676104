//! Assumptions the verdicts rest on, in words.

use super::Options;
use crate::requirement::Assumption;
use crate::translate::System;
use petril_lang::flat::Hazard;
use petril_lang::semantics::{Role, VarId};
use petril_logic::View;

/// Lists the assumptions for a system checked with these options; `timed` says that requirements speak of time.
pub fn assumptions(system: &System, options: &Options, timed: bool) -> Vec<String> {
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
        let dead = component.dead_transitions().into_iter().map(|position| &component.transitions[position]);
        assumptions.extend(dead.map(|transition| format!("`{}` never fires: nothing enables it", transition.name)));
    }
    let (restricted, any): (Vec<VarId>, Vec<VarId>) = system
        .free_inputs()
        .partition(|input| !program.variable(*input).ty.is_bool() || system.domains.contains_key(input));
    if !any.is_empty() {
        assumptions.push(format!("{} may have any value in any scan", names(any)));
    }
    for input in restricted {
        let (domain, name) = (system.domain(input), &program.variable(input).name);
        let ranges = domain.ranges().iter();
        let ranges = ranges.map(|(from, to)| if from == to { from.to_string() } else { format!("{from}..{to}") });
        let (size, ranges) = (domain.size(), ranges.collect::<Vec<_>>().join(", "));
        assumptions.push(match size {
            1 if domain.stands_for_all() => {
                format!("{name} may have any value in any scan; nothing depends on it, so {ranges} stands for all")
            }
            _ if domain.stands_for_all() => format!(
                "{name} may have any value in any scan; it is only compared with constants, so {size} values stand for \
                 all: {ranges}"
            ),
            1 => format!("{name} is {ranges} in every scan"),
            _ => format!("{name} may have any of {size} values in any scan: {ranges}"),
        });
    }
    assumptions.extend(arithmetic(system, options));
    for Assumption { name, sentence, text, .. } in &options.assumptions {
        let said = match (name, sentence) {
            (_, Some(sentence)) => format!("{sentence}: `{text}`"),
            (Some(name), None) => format!("{name}: `{text}`"),
            (None, None) => format!("`{text}`"),
        };
        assumptions.push(format!("in every scan, {said}"));
    }
    if program.scan_time.is_none() && timed {
        assumptions.push(format!("a scan begins every {} ms", program.cycle));
    }
    if let Some(time) = program.scan_time {
        assumptions.push(format!("a scan begins every {time} ms; during a scan the clock stands still"));
        if program.presets_vary {
            assumptions.push("a timer's preset time does not grow while the timer runs and is not called".to_owned());
        }
    }
    assumptions.extend(options.fairness.iter().map(|assumed| assumed.words.clone()));
    assumptions
}

/// Assumptions about overflow and division by zero.
fn arithmetic(system: &System, options: &Options) -> Vec<String> {
    let hazards = system.program.hazards();
    let tolerated = |hazard| match hazard {
        Hazard::Overflow if options.tolerated.overflow => Some("numbers that do not fit their type wrap around"),
        Hazard::DivisionByZero if options.tolerated.division_by_zero => Some("a division by zero gives 0"),
        _ => None,
    };
    let mut assumptions: Vec<String> = hazards.iter().filter_map(|&h| tolerated(h)).map(str::to_owned).collect();
    if options.view == View::Transition && hazards.iter().any(|&hazard| !options.tolerated.allows(hazard)) {
        assumptions
            .push("after an error the program goes on, as it would with `--overflow wrap --div0 zero`".to_owned());
    }
    assumptions
}
