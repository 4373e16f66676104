//! The token game over the net and the interpreter over flat code compute the same, on random programs.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::collections::HashSet;

use petril::flat::FlatProgram;
use petril::interpret::{Fault, Machine};
use petril::net::Marking;
use petril::semantics::{Role, VarId};
use petril::translate::{PlaceRole, Plant, System, TransitionRole};
use proptest::prelude::*;
use support::random_program;

/// The value of each variable, read off a marking; both or no place of a bit marked would be no value.
fn memory(system: &System, marking: &Marking) -> Vec<Option<bool>> {
    let is = |variable, value| marking.is_marked(system.place(PlaceRole::Bit { variable, bit: 0, value }));
    let variables = (0..system.program.variables.len()).map(VarId);
    variables
        .map(|v| match (is(v, false), is(v, true)) {
            (true, false) => Some(false),
            (false, true) => Some(true),
            _ => None,
        })
        .collect()
}

/// Plays one scan on the net with these inputs, by firing whatever is enabled; `None` if it never ends.
fn play(system: &System, marking: &mut Marking, inputs: &[bool]) -> Option<()> {
    let values: Vec<(VarId, bool)> = system.program.with_role(Role::Input).zip(inputs.iter().copied()).collect();
    let end = system.place(PlaceRole::Line(system.program.end()));
    let mut seen = HashSet::new();
    while !marking.is_marked(end) {
        let chosen: Vec<_> = (system.net.enabled(marking))
            .filter(|t| match system.transitions[t.index()] {
                TransitionRole::Copy { variable, value, .. } => values.contains(&(variable, value)),
                _ => true,
            })
            .collect();
        assert_eq!(chosen.len(), 1, "the program is deterministic");
        system.net.fire(marking, chosen[0]).expect("the net is safe");
        if !seen.insert(marking.clone()) {
            return None;
        }
    }
    Some(())
}

fn agree(program: FlatProgram, scans: &[[bool; 3]]) -> Result<(), TestCaseError> {
    let system = System::new(program, Plant::default());
    let mut machine = Machine::new(&system.program);
    let mut marking = system.net.initial_marking();
    for inputs in scans {
        for (input, &value) in system.program.with_role(Role::Input).zip(inputs) {
            machine.set(input, u64::from(value));
        }
        match (machine.scan(), play(&system, &mut marking, inputs)) {
            (Ok(()), Some(())) => {}
            (Err(Fault::Endless), None) => return Ok(()),
            (interpreted, played) => prop_assert!(false, "interpreter {interpreted:?}, net {played:?}"),
        }
        let interpreted: Vec<_> =
            (0..system.program.variables.len()).map(|v| Some(machine.value(VarId(v)) == 1)).collect();
        prop_assert_eq!(interpreted, memory(&system, &marking));
        let unblock = system.transitions_of(TransitionRole::Unblock).next().unwrap();
        system.net.fire(&mut marking, unblock).expect("the net is safe");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn after_every_scan(text in random_program::text(12), scans in proptest::collection::vec(any::<[bool; 3]>(), 1..12)) {
        agree(support::program(&text), &scans)?;
    }

    /// Text, tree, text: printing a program and reading it again changes nothing.
    #[test]
    fn printing_and_reading_again_changes_nothing(text in random_program::text(12)) {
        let read = |text: &str| {
            let (unit, errors) = petril::syntax::parse(&petril::source::Source::new("program", text));
            assert!(errors.is_empty(), "{text}\n{errors:?}");
            unit.to_string()
        };
        let printed = read(&text);
        prop_assert_eq!(&read(&printed), &printed);
        let (original, again) = (support::program(&text), support::program(&printed));
        let code = |p: &FlatProgram| p.code.iter().map(|line| line.instruction).collect::<Vec<_>>();
        prop_assert_eq!(code(&original), code(&again));
    }
}
