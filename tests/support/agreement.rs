//! Net and interpreter, compared.

use petril::flat::{FlatProgram, Hazard};
use petril::interpret::Machine;
use petril::semantics::VarId;
use petril::translate::{PlaceRole, System, TransitionRole};
use petril::witness::Replay;
use proptest::prelude::*;

use super::token_game::Game;

/// How many random programs are tried: `PETRIL_PROGRAMS`, if it is set.
pub fn programs(usual: u32) -> u32 {
    std::env::var("PETRIL_PROGRAMS").ok().and_then(|count| count.parse().ok()).unwrap_or(usual)
}

/// The values of the inputs in a scan.
pub type Inputs = Vec<(VarId, u64)>;

/// What happened in some scans.
#[derive(Default)]
pub struct Met {
    pub hazards: Vec<Hazard>,
    /// The end of the last scan was reached.
    pub ended: bool,
}

/// Plays scans on the net beside the interpreter, and compares both after every instruction. A scan is not followed further
/// than some steps.
pub fn agree(game: &mut Game, program: &FlatProgram, scans: &[Inputs], steps: usize) -> Result<Met, TestCaseError> {
    let mut machine = Machine::new(program);
    let mut met = Met::default();
    let variables = || (0..program.variables.len()).map(VarId);
    for inputs in scans {
        for &(input, value) in inputs {
            machine.set(input, value);
        }
        machine.begin_scan();
        let wanted = |role| match role {
            TransitionRole::Copy { variable, bit, value } => {
                inputs.iter().any(|&(input, pattern)| input == variable && (pattern >> bit & 1 == 1) == value)
            }
            _ => true,
        };
        while game.control() != PlaceRole::Line(0) {
            game.fire(wanted);
        }
        let mut width = 1;
        for _ in 0..steps {
            if machine.at_end() {
                break;
            }
            let instruction = program.code[machine.line()].instruction;
            game.hazards.clear();
            let line = machine.line();
            game.fire(|_| true);
            while !matches!(game.control(), PlaceRole::Line(_)) {
                game.fire(|_| true);
            }
            let hazard = machine.step();
            let found: Vec<(usize, Hazard)> = std::mem::take(&mut game.hazards);
            let text = program.text(instruction);
            prop_assert_eq!(found, hazard.map(|hazard| (line, hazard)).into_iter().collect::<Vec<_>>(), "{}", text);
            prop_assert!(hazard.is_none_or(|hazard| instruction.hazards().contains(&hazard)), "{}", text);
            prop_assert_eq!(game.control(), PlaceRole::Line(machine.line()), "{}", text);
            for variable in variables() {
                prop_assert_eq!(game.value(variable), Some(machine.value(variable)), "{} in {}", text, variable.0);
            }
            width = instruction.gives().map_or(width, |ty| ty.width);
            let result = machine.result() & (u64::MAX >> (64 - width));
            prop_assert_eq!(game.result(width), Some(result), "{} in the current result", text);
            prop_assert!(game.registers_are_clear(), "{}", text);
            met.hazards.extend(hazard);
        }
        if !machine.at_end() {
            return Ok(met);
        }
        met.ended = true;
        game.fire(|_| true);
    }
    Ok(met)
}

/// The replay of the same scans finds nothing to complain of.
pub fn replay(system: &System, scans: &[Inputs]) -> Result<(), TestCaseError> {
    let mut replay = Replay::new(system);
    let fire = |replay: &mut Replay<'_>, role: &dyn Fn(TransitionRole) -> bool| {
        replay.fire_only(role).map_err(|what| TestCaseError::fail(what.to_string()))
    };
    for inputs in scans {
        fire(&mut replay, &|role| role == TransitionRole::Block)?;
        for &(variable, pattern) in inputs {
            for bit in (0..system.program.variable(variable).bits).rev() {
                let copy = TransitionRole::Copy { variable, bit, value: pattern >> bit & 1 == 1 };
                fire(&mut replay, &|role| role == copy)?;
            }
        }
        while !replay.is_at(PlaceRole::Line(system.program.end())) {
            fire(&mut replay, &|role| matches!(role, TransitionRole::Line(_)))?;
        }
        fire(&mut replay, &|role| role == TransitionRole::Unblock)?;
    }
    Ok(())
}
