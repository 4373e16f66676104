//! Runs told line by line, against an interpreter and a token game that run beside the telling and know nothing of it.
#![allow(clippy::panic, clippy::unwrap_used, reason = "a test that panics has failed")]

use std::fs;

use petril::interpret::Machine;
use petril::semantics::VarId;
use petril::translate::{PlaceRole, System};
use petril::verdict::{Report, Trace};
use petril::witness::{FiringTrace, ScanTrace, firing_story, story};
use support::forms::{EXAMPLES, root};
use support::reports::report;
use support::systems::{CYLINDER, EVERY_INSTRUCTION, system};

/// Everything that is told of a run in scans is what the machine does, and what fires leads where the values say.
fn assert_told(system: &System, trace: &ScanTrace) -> usize {
    let told = story(system, trace, 0, usize::MAX).unwrap().unwrap();
    assert_eq!(told.len(), trace.scans.len());
    let last = trace.scans.len() - 1;
    assert_eq!(
        story(system, trace, last, usize::MAX).unwrap().unwrap()[0],
        told[last],
        "told alone or with the others"
    );
    let program = &system.program;
    let mut machine = Machine::new(program);
    let mut marking = system.net.initial_marking();
    let mut fire = |transitions: &[petril::net::TransitionId], system: &System| {
        for &transition in transitions {
            assert!(system.net.is_enabled(&marking, transition), "{}", system.net.transition(transition).name);
            system.net.fire(&mut marking, transition).unwrap();
        }
        marking.clone()
    };
    let mut instructions = 0;
    for (scan, told) in trace.scans.iter().zip(&told) {
        fire(&told.opening, system);
        scan.inputs.iter().for_each(|&(input, value)| machine.set(input, value));
        machine.begin_scan();
        for executed in &told.instructions {
            instructions += 1;
            assert_eq!(executed.line, machine.line());
            let before = machine.clone();
            let hazard = machine.step();
            assert_eq!(executed.hazard, hazard);
            assert_eq!(executed.result, machine.result() & executed.ty.mask());
            if let Some(ty) = program.code[executed.line].instruction.gives() {
                assert_eq!(executed.ty, ty);
            }
            let different = (0..program.variables.len()).map(VarId).find(|&id| before.value(id) != machine.value(id));
            assert_eq!(executed.changes, different.is_some());
            match (executed.writes, different) {
                (Some((id, value)), None) => assert_eq!(machine.value(id), value),
                (writes, Some(id)) => assert_eq!(writes, Some((id, machine.value(id)))),
                (None, None) => {}
            }
            let marking = fire(&executed.firings, system);
            assert!(
                marking.is_marked(system.place(PlaceRole::Line(machine.line()))),
                "control is where the machine is"
            );
            for id in (0..program.variables.len()).map(VarId) {
                assert_eq!(system.value(id, |place| marking.is_marked(place)), Some(machine.value(id)));
            }
        }
        let marking = fire(&told.closing, system);
        assert_eq!(scan.end.is_some(), !told.closing.is_empty());
        if let Some(end) = &scan.end {
            assert!(marking.is_marked(system.place(PlaceRole::Idle)));
            assert!(program.declared().all(|id| end.memory[id.0] == machine.value(id)));
        }
    }
    // A limit that is one too small tells nothing.
    assert_eq!(story(system, trace, 0, instructions - 1).unwrap(), None);
    assert!(story(system, trace, 0, instructions).unwrap().is_some());
    instructions
}

fn scans(report: &Report) -> Vec<&ScanTrace> {
    let answers = report.answers.iter().chain(&report.checks);
    let traces = answers.flat_map(petril::exchange::runs).filter_map(|(_, witness)| match &witness.trace {
        Trace::Scans(trace) => Some(trace),
        Trace::Firings(_) => None,
    });
    traces.collect()
}

#[test]
fn what_is_told_of_a_scan_is_what_happens() {
    let read = |file: String| fs::read_to_string(root().join(file)).unwrap();
    let mut instructions = 0;
    for (program, plant) in EXAMPLES {
        let system = system(&read(format!("examples/{program}.il")), &[&read(format!("nets/{plant}.net"))]);
        let report = report(&system, &read(format!("examples/{plant}.req")));
        instructions += scans(&report).into_iter().map(|trace| assert_told(&system, trace)).sum::<usize>();
    }
    assert!(instructions > 5000, "{instructions}");
}

/// A scan that never ends is told until its state repeats; an error is told where it is met.
#[test]
fn scans_that_go_wrong_are_told_too() {
    let endless = system(EVERY_INSTRUCTION, &[CYLINDER]);
    let report_of = |system: &System| report(system, "requirement nothing: AG TRUE;");
    let report = report_of(&endless);
    let run = *scans(&report).last().unwrap();
    assert_eq!(run.scans.last().unwrap().end, None);
    assert_told(&endless, run);
    let told = story(&endless, run, 0, usize::MAX).unwrap().unwrap();
    assert!(told.last().unwrap().closing.is_empty(), "its end does not come");

    let counter = system("PROGRAM p VAR c : SINT := 126; END_VAR\nLD c\nADD 1\nST c\nEND_PROGRAM", &[]);
    let report = report_of(&counter);
    let run = *scans(&report).last().unwrap();
    assert_told(&counter, run);
    let told = story(&counter, run, 0, usize::MAX).unwrap().unwrap();
    let hazards: Vec<_> = told.iter().flat_map(|scan| &scan.instructions).filter_map(|e| e.hazard).collect();
    assert_eq!(hazards.len(), 1, "127 + 1");
}

/// In the transition view the values that are told are those of the marking.
#[test]
fn what_is_told_of_firings_is_what_happens() {
    let system = system(EVERY_INSTRUCTION, &[CYLINDER]);
    // Any run will do: always the first transition that is enabled, but the plant's only in between.
    let mut marking = system.net.initial_marking();
    let mut firings = Vec::new();
    for step in 0..300 {
        let enabled: Vec<_> = system.net.transition_ids().filter(|&id| system.net.is_enabled(&marking, id)).collect();
        let Some(&transition) = enabled.get(step * 7 % enabled.len().max(1)) else { break };
        system.net.fire(&mut marking, transition).unwrap();
        firings.push(transition);
    }
    assert!(firings.len() > 100);
    let trace = FiringTrace { firings, loop_start: None };
    let told = firing_story(&system, &trace).unwrap();
    assert_eq!(told.len(), trace.firings.len());
    let mut values: Vec<u64> = system.program.variables.iter().map(|variable| variable.initial).collect();
    let mut marking = system.net.initial_marking();
    for (told, &transition) in told.iter().zip(&trace.firings) {
        assert_eq!(told.transition, transition);
        system.net.fire(&mut marking, transition).unwrap();
        let written = told.copied.or(told.executed.as_ref().and_then(|executed| executed.writes));
        if let Some((id, value)) = written {
            values[id.0] = value;
        }
        for (id, &value) in values.iter().enumerate() {
            assert_eq!(system.value(VarId(id), |place| marking.is_marked(place)), Some(value));
        }
    }
}
